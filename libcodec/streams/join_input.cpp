#include "streams/join_input.hpp"

#include "base/stream_error.hpp"
#include "container/frame_data.hpp"
#include "container/stream_writer.hpp"

#include <algorithm>
#include <utility>

#include <tvg/data.hpp>
#include <tvg/parts.hpp>

namespace tvg {

namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;

}  // namespace

Error JoinInputReader::located(Error error) const {
  error.message = input_.name + ": " + error.message;
  return error;
}

Result<ChunkReader::Event> JoinInputReader::next() {
  using Event = ChunkReader::Event;
  for (;;) {
    const Event event = reader_.next();
    switch (event) {
      case Event::kNeedBytes: {
        piece_.resize(kPieceBytes);
        const Result<std::size_t> got = input_.read(piece_);
        if (!got) return got.error();
        if (*got == 0) reader_.finish();
        reader_.push(Bytes(piece_).first(*got));
        break;
      }
      case Event::kProblem:
        return located(std::move(reader_.problem().error));
      case Event::kFailed:
        return located(reader_.error());
      case Event::kGopLost:
        return located(std::move(reader_.problem().error));
      case Event::kIndex:
        if (!reader_.index_matches()) {
          Error error = malformed("§4.6", "the index does not match the stream");
          error.byte_offset = reader_.chunk_offset();
          return located(std::move(error));
        }
        break;
      default:
        return event;
    }
  }
}

/// Keeps of a structure what is passed on later.
void JoinInputReader::use(ChunkReader::Event event) {
  const Bytes raw = reader_.raw();
  switch (event) {
    case ChunkReader::Event::kChunk: {
      const ChunkKind kind = kind_of(reader_.chunk());
      if (kind == ChunkKind::kAncillary) ++chunks_passed_over_;
      gop_start_.assign(raw.begin(), raw.end());
      break;
    }
    case ChunkReader::Event::kMetadata:
      metadata_ = reader_.take_metadata();
      break;
    case ChunkReader::Event::kData:
      data_.push_back({reader_.data_id(), std::string(reader_.data().name), chunk_with(raw), unpacked()});
      break;
    case ChunkReader::Event::kMesh:
    case ChunkReader::Event::kPlan:
      reader_.keep(std::make_shared<const std::vector<std::uint8_t>>(chunk_with(raw)));
      break;
    case ChunkReader::Event::kGop:
      gop_start_.insert(gop_start_.end(), raw.begin(), raw.end());
      gop_frames_ = reader_.gop().frame_count;
      gop_mesh_ = reader_.gop().mesh;
      gop_planes_ = plane_ids(reader_.gop());
      break;
    default:
      break;
  }
}

/// The data given out last, where join() looks into them: those at the start, the first of each name, so that
/// what is unpacked stays within bounds whatever a stream has.
std::optional<NamedData> JoinInputReader::unpacked() const {
  constexpr std::uint64_t kMostPartBytes = 256;
  const CodedData& coded = reader_.data();
  const bool is_part = coded.name == kPartData && coded.decoded_size <= kMostPartBytes;
  const bool is_wanted = is_frame_data(coded.name) || is_part;
  const auto has_name = [&coded](const DataChunk& chunk) { return chunk.name == coded.name; };
  if (!at_start_ || !is_wanted || std::any_of(data_.begin(), data_.end(), has_name)) return std::nullopt;
  Result<NamedData> data = unpack_data(coded);
  return data ? std::optional(std::move(*data)) : std::nullopt;
}

/// The chunk whose header was read last and whose payload this is.
std::vector<std::uint8_t> JoinInputReader::chunk_with(Bytes payload) const {
  std::vector<std::uint8_t> chunk(gop_start_);
  chunk.insert(chunk.end(), payload.begin(), payload.end());
  return chunk;
}

std::vector<Bytes> JoinInputReader::planes() const {
  std::vector<Bytes> chunks;
  for (const std::uint32_t id : gop_planes_) chunks.push_back(kept(reader_.plans(), id));
  return chunks;
}

Status JoinInputReader::begin() {
  for (;;) {
    const Result<ChunkReader::Event> event = next();
    if (!event) return event.error();
    use(*event);
    if (*event != ChunkReader::Event::kChunk) continue;
    const ChunkKind kind = kind_of(reader_.chunk());
    if (kind == ChunkKind::kHead || kind == ChunkKind::kMetadata || kind == ChunkKind::kData) continue;
    at_start_ = false;
    return {};
  }
}

Result<bool> JoinInputReader::next_gop() {
  for (;;) {
    const Result<ChunkReader::Event> event = next();
    if (!event) return event.error();
    if (*event == ChunkReader::Event::kEnd) return false;
    use(*event);
    if (*event == ChunkReader::Event::kGop) return true;
  }
}

Status JoinInputReader::pass_gop(const ByteSink* sink) {
  for (;;) {
    const Result<ChunkReader::Event> event = next();
    if (!event) return event.error();
    if (sink != nullptr) {
      if (Status status = (*sink)(reader_.raw()); !status.ok()) return status;
    }
    if (*event == ChunkReader::Event::kGopEnd) return {};
  }
}

}  // namespace tvg
