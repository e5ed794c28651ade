#include "source/gop_cutter.hpp"

#include <utility>

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

std::optional<GopContent> GopCutter::add(FramePositions frame, std::vector<float> joints,
                                         std::vector<std::vector<float>> values) {
  if (present_ == nullptr) present_ = std::make_shared<GopFrames>();
  present_->frames.push_back(std::move(frame));
  if (!joints.empty()) present_->joints.push_back(std::move(joints));
  present_->values.push_back(std::move(values));
  ++frames_;
  return present_->frames.size() == gop_frames_ ? flush() : std::nullopt;
}

std::optional<GopContent> GopCutter::flush() {
  if (present_ == nullptr) return std::nullopt;
  GopContent gop;
  gop.content = gop.marked_by = std::exchange(present_, nullptr);
  gop.first_frame = frames_ - gop.content->frames.size();
  if (low_delay_) {
    gop.marked_by = previous_ ? previous_ : first_frame_of(*gop.content);
    previous_ = gop.content;
  }
  return gop;
}

}  // namespace tvg
