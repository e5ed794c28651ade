#include "base/allocation.hpp"

#include <algorithm>

#include <tvg/stream_map.hpp>

namespace tvg {

namespace {

/// A list of offsets, ascending, of which those furthest back in the stream go where there are too many.
class NeededMeshes {
 public:
  explicit NeededMeshes(std::size_t most) : most_(most) {}

  /// False where there is no memory.
  bool add(std::uint64_t offset) {
    auto place = offsets_.size();
    while (place > 0 && offsets_[place - 1] > offset) --place;
    if (place > 0 && offsets_[place - 1] == offset) return true;
    if (!try_grow(offsets_, 1)) return false;
    offsets_.insert(offsets_.begin() + static_cast<std::ptrdiff_t>(place), offset);
    if (offsets_.size() > most_) offsets_.erase(offsets_.begin());
    return true;
  }
  bool full() const { return offsets_.size() == most_; }
  std::vector<std::uint64_t> take() { return std::move(offsets_); }

 private:
  std::vector<std::uint64_t> offsets_;
  std::size_t most_;
};

}  // namespace

std::uint64_t count_frames(std::span<const IndexEntry> index) {
  std::uint64_t frames = 0;
  for (const IndexEntry& entry : index) frames += entry.frame_count;
  return frames;
}

bool StreamMap::note(const Place& place) {
  if (from_index_ || (!places_.empty() && place.entry.offset <= places_.back().entry.offset)) return true;
  return try_push_back(places_, place);
}

bool StreamMap::set_index(std::span<const IndexEntry> entries) {
  places_.clear();
  std::vector<std::uint64_t> meshes;
  from_index_ = try_reserve(places_, entries.size());
  for (const IndexEntry& entry : entries) {
    if (!from_index_) return false;
    Place place{entry, frame_count(), {}};
    if (entry.kind == IndexEntry::Kind::kMesh) from_index_ = try_push_back(meshes, entry.offset);
    if (entry.meshes_back > 0 && entry.meshes_back <= meshes.size())
      place.mesh_offset = meshes[meshes.size() - entry.meshes_back];
    places_.push_back(place);
  }
  if (!from_index_) places_.clear();
  return from_index_;
}

const StreamMap::Place* StreamMap::gop_for(std::uint64_t frame) const {
  const auto begins_behind = [](std::uint64_t value, const Place& place) {
    return value < place.first_frame;
  };
  auto place = std::upper_bound(places_.begin(), places_.end(), frame, begins_behind);
  while (place != places_.begin()) {
    --place;
    if (place->entry.is_gop()) return &*place;
  }
  return nullptr;
}

std::vector<std::uint64_t> StreamMap::meshes_for(const Place& gop, std::uint32_t meshes_in_force) const {
  if (meshes_in_force <= 1)
    return gop.mesh_offset ? std::vector<std::uint64_t>{*gop.mesh_offset} : std::vector<std::uint64_t>();
  NeededMeshes needed(meshes_in_force);
  const auto first = static_cast<std::size_t>(&gop - places_.data());
  for (const Place& place : places().subspan(first)) {
    const bool before = place.mesh_offset && *place.mesh_offset < gop.entry.offset;
    if (before && !needed.add(*place.mesh_offset)) return {};
  }
  for (std::size_t i = first; !from_index_ && i-- > 0 && !needed.full();) {
    if (places_[i].entry.kind == IndexEntry::Kind::kMesh && !needed.add(places_[i].entry.offset)) return {};
  }
  return needed.take();
}

const StreamMap::Place* StreamMap::at(std::uint64_t offset) const {
  std::size_t first = 0;
  for (std::size_t end = places_.size(); first < end;) {
    const std::size_t middle = first + (end - first) / 2;
    if (places_[middle].entry.offset < offset) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return first < places_.size() && places_[first].entry.offset == offset ? &places_[first] : nullptr;
}

bool StreamMap::matches(std::span<const IndexEntry> entries) const {
  return std::equal(places_.begin(), places_.end(), entries.begin(), entries.end(),
                    [](const Place& place, const IndexEntry& entry) { return place.entry == entry; });
}

}  // namespace tvg
