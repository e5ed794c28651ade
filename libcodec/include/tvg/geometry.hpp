#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

// What is worked out about meshes and points in one place: boxes, which faces meet at a vertex, which points
// are one.
namespace tvg {

/// An axis-aligned box that grows with the points it is shown. A point with a coordinate that is infinite or
/// not a number does not count.
class BoundingBox {
 public:
  /// `positions`: [vertex][xyz].
  void extend(std::span<const float> positions);
  void extend(double x, double y, double z);
  /// Moves every side outwards by `margin`.
  void pad(double margin);

  bool empty() const { return empty_; }
  /// The smallest and the largest corner; (0, 0, 0) of an empty box.
  const std::array<double, 3>& low() const { return low_; }
  const std::array<double, 3>& high() const { return high_; }
  std::array<double, 3> center() const;
  /// The longest side; 0 where all points are one or there are none.
  double largest_extent() const;
  double diagonal() const;

 private:
  bool empty_ = true;
  std::array<double, 3> low_{}, high_{};
};

/// The box around all these frames, [frame][vertex][xyz].
BoundingBox box_around(std::span<const FramePositions> frames);

/// Numbers sorted into groups, each group in the order they came in: two passes over what is to be sorted, no
/// comparisons.
class Groups {
 public:
  Groups() = default;
  /// `visit(put)` calls put(group, number) for everything there is, groups below `count`. It is called twice
  /// and must say the same both times.
  template <class Visit>
  Groups(std::size_t count, Visit&& visit) : begin_(count + 2, 0) {
    visit([this](std::size_t group, std::uint32_t) { ++begin_[group + 2]; });
    for (std::size_t group = 2; group < begin_.size(); ++group) begin_[group] += begin_[group - 1];
    numbers_.resize(begin_.back());
    // begin_[group + 1] runs from the group's first place to its end, which is the next one's beginning.
    visit([this](std::size_t group, std::uint32_t number) { numbers_[begin_[group + 1]++] = number; });
  }

  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return std::span(numbers_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> numbers_;
};

/// Which faces meet at each vertex. A face counts once at each of its distinct corners.
class OneRings {
 public:
  /// Every index of the mesh's faces is below its vertex count.
  explicit OneRings(const Mesh& mesh);

  /// Ascending.
  std::span<const std::uint32_t> faces_at(std::uint32_t vertex) const { return faces_[vertex]; }

 private:
  Groups faces_;
};

/// Points that are one vertex.
struct Weld {
  std::vector<std::uint32_t> vertex_of_point;  ///< [point]; vertices are numbered by first appearance
  std::vector<std::uint32_t> first_point;      ///< [vertex]: the first point that is this vertex

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(first_point.size()); }
};

/// Welds the points 0 to `count` - 1 (at most 2^32 - 1) that are equal: `equal(a, b)` for two points,
/// `hash(point)` -> std::uint64_t, the same for equal ones and well mixed in its low bits.
template <class Hash, class Equal>
Weld weld_points(std::size_t count, Hash&& hash, Equal&& equal) {
  constexpr std::uint32_t kFree = UINT32_MAX;
  Weld weld;
  weld.vertex_of_point.reserve(count);
  std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 1), kFree);  // of vertices, open addressing
  for (std::uint32_t point = 0; point < count; ++point) {
    std::size_t slot = static_cast<std::size_t>(hash(point)) & (table.size() - 1);
    while (table[slot] != kFree && !equal(weld.first_point[table[slot]], point)) {
      slot = (slot + 1) & (table.size() - 1);
    }
    if (table[slot] == kFree) {
      table[slot] = weld.vertex_count();
      weld.first_point.push_back(point);
    }
    weld.vertex_of_point.push_back(table[slot]);
  }
  return weld;
}

/// Mixes `word` into a hash for weld_points().
constexpr std::uint64_t mix_hash(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
  return hash ^ hash >> 29;
}

/// Welds points whose positions ([point][xyz]) agree to the bit.
Weld weld_positions(std::span<const float> positions);

}  // namespace tvg
