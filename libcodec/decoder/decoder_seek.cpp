#include "decoder/decoder_state.hpp"

#include <algorithm>
#include <string>

// Going to a frame: which chunk to go on at, and what lies between it and the frame.
namespace tvg {

Result<std::uint64_t> Decoder::State::seek(std::uint64_t frame) {
  if (!has_head_) {
    return Error{ErrorCode::kInvalidArgument, "the head of the stream has not been read yet", {}, {}, ""};
  }
  if (map_.from_index() && frame >= map_.frame_count()) {
    return Error{ErrorCode::kInvalidArgument,
                 "there is no frame " + std::to_string(frame) + ": the stream has " +
                     std::to_string(map_.frame_count()),
                 {},
                 frame,
                 ""};
  }
  const StreamMap::Place* const gop_place = map_.gop_for(frame);
  const std::uint64_t known_end = map_.frame_count();
  const bool inside =
      frames_left_in_gop() > 0 && frame >= position_ && frame < gop_info.first_frame + gop_info.frame_count;
  const bool beyond = !map_.from_index() && frame >= known_end && position_ >= known_end &&
                      phase_ != Phase::kFailed && phase_ != Phase::kEnded;
  target_ = frame;
  if (inside || beyond || gop_place == nullptr) return offset_ + available().size();
  const StreamMap::Place* const mesh_place = map_.mesh_of(*gop_place);
  const bool in_force = has_mesh_ && (mesh_place == nullptr || mesh_place->entry.offset == mesh_offset_);
  const StreamMap::Place& place = in_force || mesh_place == nullptr ? *gop_place : *mesh_place;
  jump(place.entry.offset, place.first_frame);
  return offset_;
}

void Decoder::State::jump(std::uint64_t new_offset, std::uint64_t frame) {
  buffer_.clear();
  begin_ = 0;
  offset_ = new_offset;
  phase_ = Phase::kChunkHeader;
  deferred_.reset();
  unreported_loss_.reset();
  searched_ = false;
  label_known_ = false;
  position_ = frame;
  lost_anything_ = true;  // chunks were passed over: the index cannot be compared with what was seen
  input_finished = false;
}

std::uint64_t Decoder::State::skip() {
  if (phase_ == Phase::kSkip) {
    const std::uint64_t left = payload_left_ + kChunkChecksumSize;
    if (available().size() >= left) return 0;  // poll() has not passed over them yet
    const std::uint64_t count = left - available().size();
    consume(available().size());
    offset_ += count;
    phase_ = Phase::kChunkHeader;
    return count;
  }
  if (phase_ != Phase::kChunkHeader || !target_ || !map_.from_index() || !has_mesh_) return 0;
  const StreamMap::Place* const gop_place = map_.gop_for(*target_);
  const StreamMap::Place* const mesh_place = gop_place != nullptr ? map_.mesh_of(*gop_place) : nullptr;
  const std::uint64_t input_offset = offset_ + available().size();
  if (mesh_place == nullptr || mesh_place->entry.offset != mesh_offset_ ||
      gop_place->entry.offset <= input_offset) {
    return 0;
  }
  jump(gop_place->entry.offset, gop_place->first_frame);
  return offset_ - input_offset;
}

/// The GOP whose header was just read ends before the frame sought.
std::optional<Decoder::Event> Decoder::State::pass_gop(std::uint32_t frame_count, std::uint64_t missing,
                                                       std::size_t header_bytes) {
  std::optional<Event> event = check_place(frame_count);
  if (unreported_loss_) event = report_loss(missing, *std::exchange(unreported_loss_, std::nullopt));
  map_.note({IndexEntry::Kind::kGop, chunk_offset_, frame_count}, position_);
  position_ += frame_count;
  lost_anything_ = true;  // what is passed over is not checked
  payload_left_ -= header_bytes;
  consume(header_bytes);
  phase_ = Phase::kSkip;
  return event;
}

/// An index that came from elsewhere must not lead to wrong frame numbers.
std::optional<Decoder::Event> Decoder::State::check_place(std::uint32_t frame_count) {
  if (!map_.from_index()) return std::nullopt;
  const StreamMap::Place* const place = map_.at(chunk_offset_);
  if (place != nullptr && place->entry.kind == IndexEntry::Kind::kGop &&
      place->entry.frame_count == frame_count) {
    return std::nullopt;
  }
  map_ = StreamMap();
  return report_loss(
      0, {ErrorCode::kMalformed, "the index does not match the stream", chunk_offset_, {}, "§4.6"});
}

}  // namespace tvg
