#include "base/stream_error.hpp"
#include "container/chunk_reader.hpp"
#include "container/stream_writer.hpp"

#include <new>
#include <string>
#include <utility>

#include <tvg/relay.hpp>

namespace tvg {

class StreamSplitter::State {
 public:
  explicit State(const RelayLimits& limits) : limits_(limits), reader_(limits.stream) {}

  Status push(Bytes bytes) {
    bytes_pushed_ += bytes.size();
    return reader_.push(bytes) ? Status() : Status(reader_.error());
  }

  Result<std::optional<StreamPart>> next() {
    using Event = ChunkReader::Event;
    while (!error_) {
      const Event event = reader_.next();
      if (event == Event::kNeedBytes) {
        if (ended_ || reader_.state() != StreamState::kEnded) return std::optional<StreamPart>();
        ended_ = true;
        part_.kind = StreamPart::Kind::kEnd;
        return std::optional(std::exchange(part_, StreamPart()));
      }
      Result<bool> whole = use(event);
      if (!whole) {
        error_ = std::move(whole.error());
      } else if (*whole) {
        return std::optional(std::exchange(part_, StreamPart()));
      }
    }
    return *error_;
  }

  Status finish() const {
    if (error_) return *error_;
    if (ended_) return {};
    Error error =
        stream_error(ErrorCode::kTruncated, "§3.4",
                     {bytes_pushed_ == 0 ? "the stream is empty" : "the stream ends before it is complete"});
    error.byte_offset = bytes_pushed_;
    return error;
  }

 private:
  /// Takes over a structure; true when part_ is whole. What is wrong with a stream ends it here.
  Result<bool> use(ChunkReader::Event event) {
    using Event = ChunkReader::Event;
    switch (event) {
      case Event::kChunk:
        return begin_chunk();
      case Event::kHead:
        part_.kind = StreamPart::Kind::kHead;
        part_.limits = reader_.head().limits;
        return true;
      case Event::kMetadata:
        part_.kind = StreamPart::Kind::kMetadata;
        part_.metadata = reader_.take_metadata();
        return true;
      case Event::kData:
        part_.kind = StreamPart::Kind::kData;
        append();
        return true;
      case Event::kMesh:
        part_.kind = StreamPart::Kind::kMesh;
        part_.mesh = reader_.mesh_id();
        append();
        return true;
      case Event::kPlan:
        part_.kind = StreamPart::Kind::kPlan;
        part_.mesh = reader_.plan().mesh;
        part_.planes = {reader_.plan_id()};
        append();
        return true;
      case Event::kGop:
        part_.kind = StreamPart::Kind::kGop;
        part_.mesh = reader_.gop().mesh;
        part_.planes = plane_ids(reader_.gop());
        part_.frame_count = reader_.gop().frame_count;
        part_.first_frame = reader_.gop().first_frame;
        append();
        return false;
      case Event::kFrame:
      case Event::kDigest:
      case Event::kPacket:
        append();
        return false;
      case Event::kGopEnd:
        append();
        return true;
      case Event::kIndex:
        if (reader_.index_matches()) return false;
        return located(malformed("§4.6", "the index does not match the stream"));
      case Event::kGopLost:
      case Event::kProblem:
        return std::move(reader_.problem().error);
      case Event::kFailed:
        return reader_.error();
      case Event::kNeedBytes:
      case Event::kEnd:
        break;
    }
    return false;
  }

  /// Refuses a chunk that is too long by its header alone, before its payload is waited for.
  Result<bool> begin_chunk() {
    const ChunkHeader& header = reader_.chunk();
    if (header.total_size() > limits_.chunk_bytes) {
      return located(
          stream_error(ErrorCode::kLimitExceeded, "§8.1",
                       {"chunk '", text(header.type), "' has ", std::to_string(header.total_size()),
                        " bytes, the limit set here is ", std::to_string(limits_.chunk_bytes)}));
    }
    const ChunkKind kind = kind_of(header);
    part_ = StreamPart();
    if (kind == ChunkKind::kGop || kind == ChunkKind::kMesh || kind == ChunkKind::kPlan ||
        kind == ChunkKind::kData)
      append();
    return false;
  }

  void append() {
    const Bytes raw = reader_.raw();
    part_.chunk.insert(part_.chunk.end(), raw.begin(), raw.end());
  }

  Error located(Error error) const {
    error.byte_offset = reader_.chunk_offset();
    return error;
  }

  RelayLimits limits_;
  ChunkReader reader_;
  StreamPart part_;  ///< as far as it is there
  std::optional<Error> error_;
  std::uint64_t bytes_pushed_ = 0;
  bool ended_ = false;
};

StreamSplitter::StreamSplitter(const RelayLimits& limits) : state_(std::make_unique<State>(limits)) {}
StreamSplitter::~StreamSplitter() = default;
StreamSplitter::StreamSplitter(StreamSplitter&&) noexcept = default;
StreamSplitter& StreamSplitter::operator=(StreamSplitter&&) noexcept = default;

Status StreamSplitter::push(std::span<const std::uint8_t> bytes) {
  try {
    return state_->push(bytes);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

Result<std::optional<StreamPart>> StreamSplitter::next() {
  try {
    return state_->next();
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

Status StreamSplitter::finish() const {
  return state_->finish();
}

class StreamAssembler::State {
 public:
  explicit State(ByteSink sink) : writer(std::move(sink)) {}

  StreamWriter writer;
  std::uint64_t gops = 0;
};

StreamAssembler::StreamAssembler(ByteSink sink) : state_(std::make_unique<State>(std::move(sink))) {}
StreamAssembler::~StreamAssembler() = default;
StreamAssembler::StreamAssembler(StreamAssembler&&) noexcept = default;
StreamAssembler& StreamAssembler::operator=(StreamAssembler&&) noexcept = default;

Status StreamAssembler::begin(const StreamLimits& limits, const Metadata& metadata) {
  return state_->writer.write_start(limits, metadata);
}

Status StreamAssembler::write_data(std::span<const std::uint8_t> chunk) {
  return state_->writer.write(chunk);
}

Status StreamAssembler::write_mesh(std::span<const std::uint8_t> chunk, Again again) {
  return state_->writer.write_mesh_chunk(chunk, again == Again::kWrite);
}

Status StreamAssembler::write_plan(std::span<const std::uint8_t> chunk, Again again) {
  return state_->writer.write_plan_chunk(chunk, again == Again::kWrite);
}

Status StreamAssembler::write_gop(std::span<const std::uint8_t> chunk, std::uint32_t frame_count) {
  ++state_->gops;
  return state_->writer.write_gop_chunk(chunk, frame_count);
}

Status StreamAssembler::end() {
  return state_->writer.write_end();
}

std::uint64_t StreamAssembler::gops() const {
  return state_->gops;
}

std::uint64_t StreamAssembler::bytes() const {
  return state_->writer.offset();
}

}  // namespace tvg
