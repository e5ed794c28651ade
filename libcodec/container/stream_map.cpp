#include "base/allocation.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <tvg/stream_map.hpp>

namespace tvg {

namespace {

/// A list of offsets, ascending, of which those furthest back in the stream go where there are too many.
class NeededChunks {
 public:
  explicit NeededChunks(std::size_t most) : most_(most) {}

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
  std::span<const std::uint64_t> offsets() const { return offsets_; }

 private:
  std::vector<std::uint64_t> offsets_;
  std::size_t most_;
};

/// What decoding needs that begins at a GOP, of meshes and planes.
struct Needed {
  NeededChunks meshes, plans;

  bool full() const { return meshes.full() && plans.full(); }

  /// Adds what this GOP names and what lies before `end`, but for so many chunks of planes at the end, the
  /// first always. False where there is no memory.
  bool add_for(const StreamMap::Place& gop, std::uint64_t end, std::uint32_t left_out) {
    if (gop.mesh_offset && *gop.mesh_offset < end && !meshes.add(*gop.mesh_offset)) return false;
    const auto named = gop.plan_offsets.numbers();
    const auto plan_offsets =
        named.first(named.size() -
                    std::min<std::size_t>(left_out, named.size() - std::min<std::size_t>(named.size(), 1)));
    return std::all_of(plan_offsets.begin(), plan_offsets.end(),
                       [&](std::uint64_t plan) { return plan >= end || plans.add(plan); });
  }

  /// Adds the mesh or the planes of this place, which may be named. False where there is no memory.
  bool add_chunk(const IndexEntry& place) {
    if (place.kind == IndexEntry::Kind::kMesh) return meshes.full() || meshes.add(place.offset);
    return place.kind != IndexEntry::Kind::kPlan || plans.full() || plans.add(place.offset);
  }

  /// All of them, ascending. Empty where there is no memory.
  std::vector<std::uint64_t> take() const {
    std::vector<std::uint64_t> all;
    if (!try_resize(all, meshes.offsets().size() + plans.offsets().size())) return {};
    const auto first = meshes.offsets(), second = plans.offsets();
    std::merge(first.begin(), first.end(), second.begin(), second.end(), all.begin());
    return all;
  }
};

/// The offsets of chunks that are so many back from the end of the list; of none where one is not there.
/// Nothing where there is no memory.
std::optional<PlaneList> offsets_of(const PlaneList& back, std::span<const std::uint64_t> chunks) {
  std::array<std::uint64_t, 256> offsets{};
  std::size_t count = 0;
  for (const std::uint64_t number : back.numbers()) {
    if (number == 0 || number > chunks.size() || count == offsets.size()) return PlaneList();
    offsets[count++] = chunks[chunks.size() - static_cast<std::size_t>(number)];
  }
  return PlaneList::of(std::span(offsets).first(count));
}

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
  std::vector<std::uint64_t> meshes, plans;
  from_index_ = try_reserve(places_, entries.size());
  for (const IndexEntry& entry : entries) {
    if (!from_index_) return false;
    Place place{entry, frame_count(), {}, {}};
    if (entry.kind == IndexEntry::Kind::kMesh) from_index_ = try_push_back(meshes, entry.offset);
    if (entry.kind == IndexEntry::Kind::kPlan) from_index_ = try_push_back(plans, entry.offset);
    if (entry.meshes_back > 0 && entry.meshes_back <= meshes.size())
      place.mesh_offset = meshes[meshes.size() - entry.meshes_back];
    std::optional<PlaneList> plan_offsets = offsets_of(entry.planes_back, plans);
    from_index_ = from_index_ && plan_offsets;
    if (plan_offsets) place.plan_offsets = *std::move(plan_offsets);
    places_.push_back(std::move(place));
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

std::vector<std::uint64_t> StreamMap::needed_for(const Place& gop, const StreamLimits& limits,
                                                 std::uint32_t lod) const {
  const bool has_planes = limits.plan_bytes > 0;
  if (limits.meshes <= 1 && !has_planes)
    return gop.mesh_offset ? std::vector<std::uint64_t>{*gop.mesh_offset} : std::vector<std::uint64_t>();
  Needed needed{NeededChunks(limits.meshes), NeededChunks(has_planes ? limits.plans : 0)};
  const auto first = static_cast<std::size_t>(&gop - places_.data());
  for (const Place& place : places().subspan(first)) {
    if (place.entry.is_gop() && !needed.add_for(place, gop.entry.offset, from_index_ ? lod : 0)) return {};
  }
  for (std::size_t i = first; !from_index_ && i-- > 0 && !needed.full();) {
    if (!needed.add_chunk(places_[i].entry)) return {};
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
