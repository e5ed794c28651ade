#include "player/playback/stream_facts.hpp"

#include <algorithm>
#include <iterator>

namespace tvg::player {

namespace {

// A live stream may go on for days.
constexpr std::size_t kMostMarks = std::size_t{1} << 18;
constexpr std::size_t kMostDamage = 1024;
constexpr std::size_t kMostPackets = std::size_t{1} << 14;

}  // namespace

void StreamFacts::use_index(const std::vector<IndexEntry>& entries, std::uint64_t end) {
  marks_.clear();
  const StreamMap map(entries);
  const std::span<const StreamMap::Place> places = map.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const IndexEntry& entry = places[i].entry;
    if (!entry.is_gop()) continue;
    const std::uint64_t next = i + 1 < places.size() ? places[i + 1].entry.offset : end;
    marks_.push_back({places[i].first_frame, entry.frame_count, entry.offset,
                      next > entry.offset ? next - entry.offset : 0});
  }
  has_index_ = true;
  frame_count_ = map.frame_count();
  shared_marks_.reset();
}

void StreamFacts::note_gop(const GopMark& mark) {
  if (has_index_ || mark.first_frame < known_end()) return;
  if (marks_.size() >= kMostMarks) marks_.erase(marks_.begin(), marks_.begin() + kMostMarks / 4);
  marks_.push_back(mark);
  shared_marks_.reset();
}

void StreamFacts::note_damage(const Damage& damage, std::uint64_t first_frame) {
  const FrameRun run{first_frame, damage.frame_count};
  const bool known = std::any_of(damage_.begin(), damage_.end(),
                                 [&run](const DamageMark& mark) { return mark.frames == run; });
  if (known || damage_.size() >= kMostDamage) return;
  damage_.push_back({run, damage.error.describe()});
}

void StreamFacts::note_frame(std::uint64_t frame, std::uint64_t bytes) {
  packets_[frame] = bytes;
  if (packets_.size() <= kMostPackets) return;
  // The end that lies further from what is played now is the less interesting one.
  const std::uint64_t behind = frame - packets_.begin()->first;
  const std::uint64_t ahead = packets_.rbegin()->first - frame;
  packets_.erase(behind >= ahead ? packets_.begin() : std::prev(packets_.end()));
}

void StreamFacts::note_end(std::uint64_t frames) {
  if (!has_index_) frame_count_ = frames;
}

const GopMark* StreamFacts::gop_of(std::uint64_t frame) const {
  const auto behind =
      std::upper_bound(marks_.begin(), marks_.end(), frame,
                       [](std::uint64_t number, const GopMark& mark) { return number < mark.first_frame; });
  if (behind == marks_.begin()) return nullptr;
  const GopMark& mark = *std::prev(behind);
  return frame < end_of(mark) ? &mark : nullptr;
}

GopMarks StreamFacts::gop_marks() const {
  if (!shared_marks_) shared_marks_ = std::make_shared<const std::vector<GopMark>>(marks_);
  return shared_marks_;
}

std::vector<FrameBytes> StreamFacts::frame_bytes(std::uint64_t first, std::uint64_t last) const {
  std::vector<FrameBytes> result;
  for (auto at = packets_.lower_bound(first); at != packets_.end() && at->first <= last; ++at) {
    result.push_back({at->first, at->second});
  }
  return result;
}

std::vector<FrameRun> frames_of_bytes(const std::vector<GopMark>& marks,
                                      const std::vector<ByteRange>& bytes) {
  std::vector<FrameRun> runs;
  auto range = bytes.begin();
  for (const GopMark& mark : marks) {
    while (range != bytes.end() && range->offset + range->size <= mark.offset) ++range;
    if (range == bytes.end()) break;
    if (range->offset > mark.offset || mark.bytes == 0) continue;  // without its header a GOP cannot be read
    const std::uint64_t there = std::min(range->offset + range->size - mark.offset, mark.bytes);
    const auto count = static_cast<std::uint64_t>(
        static_cast<double>(mark.frame_count) * static_cast<double>(there) / static_cast<double>(mark.bytes));
    if (count == 0) continue;
    if (!runs.empty() && runs.back().first + runs.back().count == mark.first_frame) {
      runs.back().count += count;
    } else {
      runs.push_back({mark.first_frame, count});
    }
  }
  return runs;
}

}  // namespace tvg::player
