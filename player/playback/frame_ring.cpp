#include "player/playback/frame_ring.hpp"

#include <algorithm>
#include <utility>

namespace tvg::player {

void FrameRing::set_capacity(std::size_t capacity) {
  capacity_ = std::max<std::size_t>(capacity, 2);
}

void FrameRing::reset(std::uint64_t first) {
  entries_.clear();
  shown_ = 0;
  continues_ = false;
  next_ = first;
}

bool FrameRing::has_room() const {
  return entries_.size() < capacity_ || (shown_ < entries_.size() && shown_ > behind_limit());
}

void FrameRing::push(std::shared_ptr<const PlayerFrame> frame) {
  while (entries_.size() >= capacity_ && shown_ > 0) {
    entries_.pop_front();
    --shown_;
  }
  const std::uint64_t number = frame->number;
  std::uint64_t from = std::min(next_, number);
  if (continues_ && !entries_.empty()) {
    if (number > next_) entries_.back().to = number - 1;
    from = number;
  }
  if (entries_.empty()) shown_ = 0;
  entries_.push_back({std::move(frame), from, number});
  continues_ = true;
  next_ = number + 1;
}

void FrameRing::pass_over(std::uint64_t first, std::uint64_t count) {
  if (!continues_ || entries_.empty() || first != next_ || count == 0) return;
  entries_.back().to += count;
  next_ += count;
}

void FrameRing::close(std::uint64_t end, std::uint64_t next) {
  if (continues_ && !entries_.empty() && end > entries_.back().to) entries_.back().to = end - 1;
  continues_ = false;
  next_ = next;
}

std::size_t FrameRing::find(std::uint64_t number) const {
  std::size_t best = entries_.size();
  std::size_t best_distance = entries_.size();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (number < entries_[i].from || number > entries_[i].to) continue;
    const std::size_t distance = i >= shown_ ? i - shown_ : shown_ - i;
    if (distance > best_distance || (distance == best_distance && best != entries_.size() && i < shown_)) {
      continue;
    }
    best = i;
    best_distance = distance;
  }
  return best;
}

std::shared_ptr<const PlayerFrame> FrameRing::show(std::uint64_t number) {
  const std::size_t found = find(number);
  if (found == entries_.size()) {
    // Too late for those in between: what follows them needs their room.
    if (continues_ && !entries_.empty() && number >= next_) shown_ = entries_.size() - 1;
    return nullptr;
  }
  shown_ = found;
  return entries_[found].frame;
}

bool FrameRing::contains(std::uint64_t number) const {
  return find(number) < entries_.size();
}

std::size_t FrameRing::ahead() const {
  return shown_ < entries_.size() ? entries_.size() - shown_ - 1 : 0;
}

std::vector<FrameRun> FrameRing::runs() const {
  std::vector<FrameRun> runs;
  for (const Entry& entry : entries_) runs.push_back({entry.from, entry.to - entry.from + 1});
  std::sort(runs.begin(), runs.end(), [](const FrameRun& a, const FrameRun& b) { return a.first < b.first; });
  std::vector<FrameRun> merged;
  for (const FrameRun& run : runs) {
    if (merged.empty() || run.first > merged.back().first + merged.back().count) {
      merged.push_back(run);
    } else {
      const std::uint64_t end = std::max(merged.back().first + merged.back().count, run.first + run.count);
      merged.back().count = end - merged.back().first;
    }
  }
  return merged;
}

}  // namespace tvg::player
