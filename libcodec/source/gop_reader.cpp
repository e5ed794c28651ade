#include "source/gop_reader.hpp"

#include "base/errors.hpp"
#include "source/source_checks.hpp"

namespace tvg {

namespace {

/// The first frame alone.
std::shared_ptr<const GopFrames> first_frame_of(const GopFrames& content) {
  auto first = std::make_shared<GopFrames>();
  first->frames.push_back(content.frames.front());
  if (!content.joints.empty()) first->joints.push_back(content.joints.front());
  return first;
}

}  // namespace

Result<std::optional<GopContent>> GopReader::next() {
  const bool with_joints = uses_skeleton(importance_);
  const auto frames = std::make_shared<GopFrames>();
  GopContent gop;
  gop.first_frame = frames_read_;
  for (; !at_end_ && frames->frames.size() < gop_frames_; ++frames_read_) {
    FramePositions frame(3 * std::size_t{source_.mesh().vertex_count});
    const Result<bool> read = read_checked(source_, frame, frames_read_);
    if (!read) return read.error();
    at_end_ = !*read;
    if (at_end_) break;
    gop.box.extend(frame);
    frames->frames.push_back(std::move(frame));
    if (!with_joints) continue;
    Result<std::vector<float>> joints = read_joints(source_, frames_read_);
    if (!joints) return joints.error();
    frames->joints.push_back(std::move(*joints));
  }
  if (frames_read_ == 0) return invalid_input("the sequence has no frames");
  if (frames->frames.empty()) return std::optional<GopContent>();
  gop.content = gop.marked_by = frames;
  if (importance_.low_delay) {
    gop.marked_by = previous_ ? previous_ : first_frame_of(*frames);
    previous_ = frames;
  }
  return std::optional(std::move(gop));
}

}  // namespace tvg
