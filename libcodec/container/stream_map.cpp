#include "base/allocation.hpp"

#include <algorithm>

#include <tvg/stream_map.hpp>

namespace tvg {

bool StreamMap::note(const IndexEntry& entry, std::uint64_t first_frame) {
  if (from_index_ || (!places_.empty() && entry.offset <= places_.back().entry.offset)) return true;
  return try_push_back(places_, Place{entry, first_frame});
}

bool StreamMap::set_index(std::span<const IndexEntry> entries) {
  places_.clear();
  from_index_ = try_reserve(places_, entries.size());
  if (!from_index_) return false;
  for (const IndexEntry& entry : entries) places_.push_back({entry, frame_count()});
  return true;
}

const StreamMap::Place* StreamMap::gop_for(std::uint64_t frame) const {
  const auto begins_behind = [](std::uint64_t value, const Place& place) {
    return value < place.first_frame;
  };
  auto place = std::upper_bound(places_.begin(), places_.end(), frame, begins_behind);
  while (place != places_.begin()) {
    --place;
    if (place->entry.kind == IndexEntry::Kind::kGop) return &*place;
  }
  return nullptr;
}

const StreamMap::Place* StreamMap::mesh_of(const Place& gop) const {
  for (auto place = places_.begin() + (&gop - places_.data()); place != places_.begin();) {
    --place;
    if (place->entry.kind == IndexEntry::Kind::kMesh) return &*place;
  }
  return nullptr;
}

const StreamMap::Place* StreamMap::at(std::uint64_t offset) const {
  const auto lies_before = [](const Place& place, std::uint64_t value) { return place.entry.offset < value; };
  const auto place = std::lower_bound(places_.begin(), places_.end(), offset, lies_before);
  return place != places_.end() && place->entry.offset == offset ? &*place : nullptr;
}

bool StreamMap::matches(std::span<const IndexEntry> entries) const {
  return std::equal(places_.begin(), places_.end(), entries.begin(), entries.end(),
                    [](const Place& place, const IndexEntry& entry) { return place.entry == entry; });
}

}  // namespace tvg
