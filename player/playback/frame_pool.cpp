#include "player/playback/frame_pool.hpp"

#include <algorithm>
#include <atomic>

namespace tvg::cli {

namespace {

bool is_free(const std::shared_ptr<PlayerFrame>& frame) {
  return frame.use_count() == 1;
}

}  // namespace

bool FramePool::has_free() const {
  return frames_.size() < limit_ || std::any_of(frames_.begin(), frames_.end(), is_free);
}

std::shared_ptr<PlayerFrame> FramePool::take() {
  const auto found = std::find_if(frames_.begin(), frames_.end(), is_free);
  if (found != frames_.end()) {
    // use_count() is read without order: the fence makes the last holder's reads come before our writes.
    std::atomic_thread_fence(std::memory_order_acquire);
    return *found;
  }
  if (frames_.size() >= limit_) return nullptr;
  frames_.push_back(std::make_shared<PlayerFrame>());
  return frames_.back();
}

void FramePool::drop_free() {
  std::erase_if(frames_, is_free);
}

}  // namespace tvg::cli
