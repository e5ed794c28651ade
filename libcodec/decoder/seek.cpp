#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "decoder/decoder_state.hpp"

#include <string>

// Going to a frame: which chunk to go on at, and what lies between it and the frame.
namespace tvg {

void Decoder::State::set_index(const std::vector<IndexEntry>& entries) {
  if (!map_.set_index(entries)) reader.fail(out_of_memory());
}

Result<std::uint64_t> Decoder::State::seek(std::uint64_t frame) {
  if (!can_allocate(kSmallThings)) return out_of_memory();
  if (!reader.has_head())
    return stream_error(ErrorCode::kInvalidArgument, "", {"the head of the stream has not been read yet"});
  if (map_.from_index() && frame >= map_.frame_count()) {
    Error error = stream_error(
        ErrorCode::kInvalidArgument, "",
        {"there is no frame ", decimal(frame), ": the stream has ", decimal(map_.frame_count())});
    error.frame = frame;
    return error;
  }
  const StreamMap::Place* const gop_place = map_.gop_for(frame);
  const std::uint64_t known_end = map_.frame_count();
  const bool inside = frames_left() > 0 && frame >= frames_.position() && frame < gop_end_;
  const bool beyond =
      !map_.from_index() && frame >= known_end && frames_.position() >= known_end && !reader.over();
  target_ = frame;
  needed_.clear();
  if (inside || beyond || gop_place == nullptr) return reader.input_offset();
  needed_ = map_.needed_for(*gop_place, reader.head().limits, lod);
  jump(*next_stop());
  deferred_ = {};
  return reader.offset();
}

/// Goes on at this mesh, at these planes or at this GOP.
void Decoder::State::jump(const StreamMap::Place& place) {
  reader.jump(place.entry.offset, needed_);
  frames_.jump(place.first_frame);
  gop_end_ = 0;
}

/// Where to go on on the way to the GOP sought: at the first chunk that it needs and that is not in force, or
/// at the GOP; null where that is not known.
const StreamMap::Place* Decoder::State::next_stop() const {
  for (const std::uint64_t offset : needed_) {
    const StreamMap::Place* const place = map_.at(offset);
    const bool held = reader.meshes().holds(offset) || reader.plans().holds(offset);
    if (place != nullptr && !held) return place;
  }
  return map_.gop_for(*target_);
}

std::uint64_t Decoder::State::skip() {
  if (!target_ && !reader.passes_unwanted()) return 0;
  if (const std::uint64_t count = reader.skip(); count > 0) return count;
  if (!target_ || !reader.at_chunk() || !map_.from_index()) return 0;
  const StreamMap::Place* const stop = next_stop();
  const std::uint64_t input_offset = reader.input_offset();
  if (stop == nullptr || stop->entry.offset <= input_offset) return 0;
  jump(*stop);
  return reader.offset() - input_offset;
}

/// Whether the GOP whose header was just read ends before the frame sought, where so many frames before it
/// are missing.
bool Decoder::State::is_on_the_way(std::uint64_t missing) const {
  return target_ && frames_.position() + missing + reader.gop().frame_count <= *target_;
}

/// Passes over such a GOP.
std::optional<Decoder::Event> Decoder::State::pass_gop(std::uint64_t missing) {
  const std::uint32_t frame_count = reader.gop().frame_count;
  reader.pass_over();
  std::optional<Event> event = check_place();
  if (frames_.has_unknown()) event = tell(frames_.lose(missing, frames_.take_cause({})));
  note_gop();
  frames_.advance(frame_count);
  return event;
}

/// Where the index has the chunk being read; null without an index.
const StreamMap::Place* Decoder::State::indexed_place() const {
  return map_.from_index() ? map_.at(reader.chunk_offset()) : nullptr;
}

/// An index that came from elsewhere must not lead to wrong frame numbers.
std::optional<Decoder::Event> Decoder::State::check_place() {
  if (!map_.from_index()) return std::nullopt;
  const StreamMap::Place* const place = indexed_place();
  if (place != nullptr && place->entry.is_gop() && place->entry.frame_count == reader.gop().frame_count) {
    return std::nullopt;
  }
  map_ = StreamMap();
  Error error = malformed("§4.6", "the index does not match the stream");
  error.byte_offset = reader.chunk_offset();
  return tell(frames_.lose(0, std::move(error)));
}

}  // namespace tvg
