#include "base/checksum.hpp"
#include "container/stream_checks.hpp"
#include "container/stream_writer.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include <tvg/relay.hpp>

namespace tvg {

namespace {

std::string text(const ChunkType& type) {
  return {type.begin(), type.end()};
}

Error out_of_memory() {
  return {ErrorCode::kOutOfMemory, "there is not enough memory for a chunk of the stream", {}, {}, ""};
}

/// The entries an index should have, as a digest: a live stream may run for days, and a list would grow.
class ExpectedIndex {
 public:
  void add(const IndexEntry& entry) {
    ByteWriter writer;
    writer.varint(entry.frame_count);
    writer.varint(entry.offset - last_offset_);
    last_offset_ = entry.offset;
    digest_.update(Bytes(writer.data()));
    ++count_;
  }

  // format-spec §4.6
  bool matches(Bytes payload) const {
    ByteReader reader(payload);
    if (reader.varint() != count_ || !reader.ok()) return false;
    Hasher digest;
    digest.update(payload.subspan(reader.position()));
    return digest.value() == digest_.value();
  }

 private:
  Hasher digest_;
  std::uint64_t count_ = 0;
  std::uint64_t last_offset_ = 0;
};

}  // namespace

class StreamSplitter::State {
 public:
  explicit State(const RelayLimits& limits) : limits_(limits) {}

  void push(Bytes bytes) {
    // What was used is dropped only here, so that a push of many small chunks moves its bytes once.
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(used_));
    used_ = 0;
    if (!error_) buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }

  Result<std::optional<StreamPart>> next() {
    while (!error_) {
      const std::size_t before = used_;
      Result<std::optional<StreamPart>> part = step();
      if (!part) {
        error_ = part.error();
      } else if (*part || used_ == before) {
        return part;
      }
    }
    return *error_;
  }

  Status finish() const {
    if (error_) return *error_;
    if (ended_) return {};
    return Error{
        ErrorCode::kTruncated,
        offset_ == 0 && available().empty() ? "the stream is empty" : "the stream ends before it is complete",
        offset_ + available().size(),
        {},
        "§3.4"};
  }

 private:
  Bytes available() const { return Bytes(buffer_).subspan(used_); }
  void consume(std::size_t size) {
    used_ += size;
    offset_ += size;
  }
  Error fail(ErrorCode code, std::string message, const char* section) const {
    return {code, std::move(message), offset_, {}, section};
  }
  Error located(Error error) const {
    error.byte_offset = offset_;
    return error;
  }

  /// Reads the next structure. Nothing where it was one to pass over or is not all there.
  Result<std::optional<StreamPart>> step() {
    if (ended_) {
      if (available().empty()) return std::optional<StreamPart>();
      return fail(ErrorCode::kMalformed, "bytes follow the stream's tail", "§4.7");
    }
    if (offset_ < kSignature.size()) return read_signature();
    if (available().size() < kChunkHeaderSize) return std::optional<StreamPart>();
    const std::optional<ChunkHeader> header = read_chunk_header(available());
    if (!header) return fail(ErrorCode::kMalformed, "a chunk header is damaged", "§3.2");
    if (Status status = check_chunk_header(*header); !status.ok()) return status.error();
    const auto size = static_cast<std::size_t>(header->total_size());
    if (available().size() < size) return std::optional<StreamPart>();

    const Bytes chunk = available().first(size);
    const Bytes payload = chunk.subspan(kChunkHeaderSize, header->length);
    const std::uint32_t expected = ByteReader(chunk.last(kChunkChecksumSize)).u32();
    if (expected != checksum(payload)) {
      return fail(ErrorCode::kChecksumMismatch, "chunk '" + text(header->type) + "' is damaged", "§3.3");
    }
    Result<std::optional<StreamPart>> part = use_chunk(*header, chunk, payload);
    if (part) consume(size);
    return part;
  }

  // format-spec §3.1
  Result<std::optional<StreamPart>> read_signature() {
    const std::size_t count = std::min(available().size(), kSignature.size());
    if (!std::equal(kSignature.begin(), kSignature.begin() + static_cast<std::ptrdiff_t>(count),
                    available().begin())) {
      return fail(ErrorCode::kNotTvg, "this is not a TVG stream: the signature is missing", "§3.1");
    }
    if (count == kSignature.size()) consume(count);
    return std::optional<StreamPart>();
  }

  /// Refuses by the header alone what would be refused later, before the payload is waited for.
  // format-spec §3.2, §3.4
  Status check_chunk_header(const ChunkHeader& header) const {
    const ChunkType& type = header.type;
    if (header.total_size() > limits_.chunk_bytes) {
      return fail(ErrorCode::kLimitExceeded,
                  "chunk '" + text(type) + "' has " + std::to_string(header.total_size()) +
                      " bytes, the limit set here is " + std::to_string(limits_.chunk_bytes),
                  "§8.1");
    }
    if (!has_head_ && type != kHeadChunk) {
      return fail(ErrorCode::kMalformed, "the stream does not begin with its head", "§3.4");
    }
    if (has_head_ && type == kHeadChunk) {
      return fail(ErrorCode::kMalformed, "the stream has a second head", "§3.4");
    }
    const bool optional_part = type == kMetadataChunk || type == kIndexChunk;
    const bool critical_part =
        type == kHeadChunk || type == kMeshChunk || type == kGopChunk || type == kTailChunk;
    if ((optional_part && !header.ancillary) || (critical_part && header.ancillary)) {
      return fail(ErrorCode::kMalformed, "a chunk's ancillary flag does not fit its type", "§3.4");
    }
    if (!optional_part && !critical_part && !header.ancillary) {
      return fail(ErrorCode::kUnsupportedVersion,
                  "the stream needs a program that knows chunk '" + text(type) + "'", "§3.2");
    }
    const bool small = type == kHeadChunk || type == kMetadataChunk || type == kTailChunk;
    if ((small && header.length > kMaxSmallPayload) ||
        (type == kMeshChunk && header.length > most_mesh_bytes(stream_limits_))) {
      return fail(ErrorCode::kMalformed, "chunk '" + text(type) + "' is too long", "§3.2");
    }
    if (type == kGopChunk && !mesh_checksum_) {
      return fail(ErrorCode::kMalformed, "a GOP comes before any mesh", "§3.4");
    }
    if (index_offset_ && type != kTailChunk && !(header.ancillary && type != kIndexChunk)) {
      return fail(ErrorCode::kMalformed, "chunk '" + text(type) + "' follows the index", "§3.4");
    }
    return {};
  }

  Result<std::optional<StreamPart>> use_chunk(const ChunkHeader& header, Bytes chunk, Bytes payload) {
    StreamPart part;
    if (header.type == kHeadChunk) return use_head(payload);
    if (header.type == kMetadataChunk) {
      Result<Metadata> metadata = read_metadata(payload);
      if (!metadata) return located(metadata.error());
      part.kind = StreamPart::Kind::kMetadata;
      part.metadata = std::move(*metadata);
      return std::optional(std::move(part));
    }
    if (header.type == kIndexChunk) {
      if (!expected_index_.matches(payload)) {
        return fail(ErrorCode::kMalformed, "the index does not match the stream", "§4.6");
      }
      index_offset_ = offset_;
      return std::optional<StreamPart>();
    }
    if (header.type == kTailChunk) return use_tail(payload);
    if (header.type == kMeshChunk) {
      if (Status status = check_mesh_payload(payload, stream_limits_); !status.ok())
        return located(status.error());
      mesh_checksum_ = checksum(payload);
      part.kind = StreamPart::Kind::kMesh;
    } else if (header.type == kGopChunk) {
      const Result<GopHeader> gop = check_gop_payload(payload, *mesh_checksum_, stream_limits_);
      if (!gop) return located(gop.error());
      part.kind = StreamPart::Kind::kGop;
      part.frame_count = gop->frame_count;
      part.first_frame = gop->first_frame;
    } else {
      return std::optional<StreamPart>();
    }
    const bool is_mesh = part.kind == StreamPart::Kind::kMesh;
    part.chunk.assign(chunk.begin(), chunk.end());
    expected_index_.add(
        {is_mesh ? IndexEntry::Kind::kMesh : IndexEntry::Kind::kGop, offset_, part.frame_count});
    return std::optional(std::move(part));
  }

  // format-spec §4.1, §8.1
  Result<std::optional<StreamPart>> use_head(Bytes payload) {
    const Result<StreamHead> head = read_head(payload);
    if (!head) return located(head.error());
    if (Status status = check_declared(head->limits, limits_.stream); !status.ok())
      return located(status.error());
    has_head_ = true;
    stream_limits_ = head->limits;
    StreamPart part;
    part.limits = head->limits;
    return std::optional(std::move(part));
  }

  // format-spec §4.7
  Result<std::optional<StreamPart>> use_tail(Bytes payload) {
    const Result<std::uint64_t> distance = read_tail(payload);
    if (!distance) return located(distance.error());
    if (!index_offset_ || *distance != offset_ - *index_offset_) {
      return fail(ErrorCode::kMalformed, "the tail does not lead to the index", "§4.7");
    }
    ended_ = true;
    StreamPart part;
    part.kind = StreamPart::Kind::kEnd;
    return std::optional(std::move(part));
  }

  RelayLimits limits_;
  std::vector<std::uint8_t> buffer_;
  std::size_t used_ = 0;      ///< bytes at the front of the buffer that are done with
  std::uint64_t offset_ = 0;  ///< in the stream, of the first byte that is not
  std::optional<Error> error_;
  bool has_head_ = false;
  bool ended_ = false;
  StreamLimits stream_limits_;
  std::optional<std::uint32_t> mesh_checksum_;
  std::optional<std::uint64_t> index_offset_;
  ExpectedIndex expected_index_;
};

StreamSplitter::StreamSplitter(const RelayLimits& limits) : state_(std::make_unique<State>(limits)) {}
StreamSplitter::~StreamSplitter() = default;
StreamSplitter::StreamSplitter(StreamSplitter&&) noexcept = default;
StreamSplitter& StreamSplitter::operator=(StreamSplitter&&) noexcept = default;

Status StreamSplitter::push(std::span<const std::uint8_t> bytes) {
  try {
    state_->push(bytes);
    return {};
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
  bool has_mesh = false;
  std::uint64_t gops = 0;
};

StreamAssembler::StreamAssembler(ByteSink sink) : state_(std::make_unique<State>(std::move(sink))) {}
StreamAssembler::~StreamAssembler() = default;
StreamAssembler::StreamAssembler(StreamAssembler&&) noexcept = default;
StreamAssembler& StreamAssembler::operator=(StreamAssembler&&) noexcept = default;

Status StreamAssembler::begin(const StreamLimits& limits, const Metadata& metadata) {
  return state_->writer.write_start(limits, metadata);
}

Status StreamAssembler::write_mesh(std::span<const std::uint8_t> chunk) {
  state_->has_mesh = true;
  return state_->writer.write_mesh_chunk(chunk);
}

Status StreamAssembler::write_gop(std::span<const std::uint8_t> chunk, std::uint32_t frame_count) {
  if (!state_->has_mesh) {
    return Error{ErrorCode::kInvalidArgument, "a GOP comes before any mesh", {}, {}, "§3.4"};
  }
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
