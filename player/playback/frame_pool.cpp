#include "player/playback/frame_pool.hpp"

#include <mutex>
#include <utility>
#include <vector>

namespace tvg::player {

/// Where frames wait that nobody holds. Frames outside keep it.
class FramePool::Shelf {
 public:
  explicit Shelf(std::shared_ptr<Bell> bell) : bell_(std::move(bell)) {}

  bool empty() const {
    const std::lock_guard lock(mutex_);
    return frames_.empty();
  }
  /// Room for `count` frames, so that put() cannot fail.
  void reserve(std::size_t count) {
    const std::lock_guard lock(mutex_);
    frames_.reserve(count);
  }
  void put(std::unique_ptr<PlayerFrame> frame) {
    {
      const std::lock_guard lock(mutex_);
      frames_.push_back(std::move(frame));
    }
    bell_->ring();
  }
  /// Null where there is none.
  std::unique_ptr<PlayerFrame> get() {
    const std::lock_guard lock(mutex_);
    if (frames_.empty()) return nullptr;
    std::unique_ptr<PlayerFrame> frame = std::move(frames_.back());
    frames_.pop_back();
    return frame;
  }

 private:
  const std::shared_ptr<Bell> bell_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<PlayerFrame>> frames_;
};

FramePool::FramePool(std::shared_ptr<Bell> bell) : shelf_(std::make_shared<Shelf>(std::move(bell))) {}

bool FramePool::has_free() const {
  return made_ < limit_ || !shelf_->empty();
}

std::shared_ptr<PlayerFrame> FramePool::take() {
  std::unique_ptr<PlayerFrame> frame = shelf_->get();
  if (frame == nullptr) {
    if (made_ >= limit_) return nullptr;
    shelf_->reserve(made_ + 1);
    frame = std::make_unique<PlayerFrame>();
    ++made_;
  }
  const auto put_back = [shelf = shelf_](PlayerFrame* used) {
    shelf->put(std::unique_ptr<PlayerFrame>(used));
  };
  return {frame.release(), put_back};
}

void FramePool::drop_free() {
  while (shelf_->get() != nullptr) --made_;
}

}  // namespace tvg::player
