#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// What a vertex is predicted from: the vertices it shares an edge with, and the parallelograms it closes
/// (format-spec §5.3). They depend on which faces there are, not on their order.
class ShapeSurroundings {
 public:
  /// A face (a, b, v) and the vertex o of the one other face at the edge from a to b: v lies near a + b - o.
  struct Wing {
    std::uint32_t a, b, o;
  };

  /// What making it takes at most, for each vertex and each face.
  static constexpr std::size_t kBytesPerVertex = 3 * sizeof(std::size_t);
  static constexpr std::size_t kBytesPerFace =
      3 * sizeof(std::uint64_t) + 3 * sizeof(Wing) + 6 * sizeof(std::uint32_t);

  /// Every index in `faces` is below `vertex_count`.
  ShapeSurroundings(std::span<const Face> faces, std::uint32_t vertex_count) {
    collect_sides(faces, vertex_count);
    ring_begin_.assign(std::size_t{vertex_count} + 2, 0);
    wing_begin_.assign(std::size_t{vertex_count} + 2, 0);
    for_each_edge([this](std::uint32_t a, std::uint32_t b, std::span<const std::uint64_t> sides) {
      ++ring_begin_[std::size_t{a} + 2];
      ++ring_begin_[std::size_t{b} + 2];
      if (sides.size() != 2) return;
      for (const std::uint64_t side : sides) ++wing_begin_[std::size_t{third(side)} + 2];
    });
    for (auto* begin : {&ring_begin_, &wing_begin_}) sum_up(*begin);
    rings_.resize(ring_begin_.back());
    wings_.resize(wing_begin_.back());
    for_each_edge([this](std::uint32_t a, std::uint32_t b, std::span<const std::uint64_t> sides) {
      rings_[ring_begin_[std::size_t{a} + 1]++] = b;
      rings_[ring_begin_[std::size_t{b} + 1]++] = a;
      if (sides.size() != 2) return;
      const std::uint32_t first = third(sides[0]), second = third(sides[1]);
      wings_[wing_begin_[std::size_t{first} + 1]++] = {a, b, second};
      wings_[wing_begin_[std::size_t{second} + 1]++] = {a, b, first};
    });
    sides_ = {};
  }

  /// The vertices that share an edge with `vertex`, ascending.
  std::span<const std::uint32_t> ring(std::uint32_t vertex) const {
    return std::span(rings_).subspan(ring_begin_[vertex], ring_begin_[vertex + 1] - ring_begin_[vertex]);
  }

  /// The parallelograms that `vertex` may close, by ascending a, then b.
  std::span<const Wing> wings(std::uint32_t vertex) const {
    return std::span(wings_).subspan(wing_begin_[vertex], wing_begin_[vertex + 1] - wing_begin_[vertex]);
  }

 private:
  /// A side of a face at the smaller end of an edge: the larger end, and the face's third corner.
  static std::uint64_t side(std::uint32_t larger, std::uint32_t third) {
    return std::uint64_t{larger} << 32 | third;
  }
  static std::uint32_t larger(std::uint64_t side) { return static_cast<std::uint32_t>(side >> 32); }
  static std::uint32_t third(std::uint64_t side) { return static_cast<std::uint32_t>(side); }

  /// Counts at [v + 2] become places at [v + 1], which filling moves on to where v + 1 begins.
  static void sum_up(std::vector<std::size_t>& begin) {
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  }

  /// The sides of all faces with three different corners, by the edge's smaller end, each list sorted.
  void collect_sides(std::span<const Face> faces, std::uint32_t vertex_count) {
    side_begin_.assign(std::size_t{vertex_count} + 2, 0);
    for (const Face& face : faces) {
      const auto [x, y, z] = sorted(face);
      if (x == y || y == z) continue;
      side_begin_[std::size_t{x} + 2] += 2;
      ++side_begin_[std::size_t{y} + 2];
    }
    sum_up(side_begin_);
    sides_.resize(side_begin_.back());
    for (const Face& face : faces) {
      const auto [x, y, z] = sorted(face);
      if (x == y || y == z) continue;
      sides_[side_begin_[std::size_t{x} + 1]++] = side(y, z);
      sides_[side_begin_[std::size_t{x} + 1]++] = side(z, y);
      sides_[side_begin_[std::size_t{y} + 1]++] = side(z, x);
    }
    for (std::size_t v = 0; v < vertex_count; ++v) sort(side_begin_[v], side_begin_[v + 1]);
  }

  /// Most lists are so short that std::sort() would take longer.
  void sort(std::size_t begin, std::size_t end) {
    if (end - begin > 24) {
      std::sort(sides_.begin() + static_cast<std::ptrdiff_t>(begin),
                sides_.begin() + static_cast<std::ptrdiff_t>(end));
      return;
    }
    for (std::size_t i = begin + 1; i < end; ++i) {
      const std::uint64_t moved = sides_[i];
      std::size_t place = i;
      for (; place > begin && sides_[place - 1] > moved; --place) sides_[place] = sides_[place - 1];
      sides_[place] = moved;
    }
  }

  static Face sorted(Face face) {
    if (face[0] > face[1]) std::swap(face[0], face[1]);
    if (face[1] > face[2]) std::swap(face[1], face[2]);
    if (face[0] > face[1]) std::swap(face[0], face[1]);
    return face;
  }

  /// Calls `use` with each edge, by ascending ends, and its different faces.
  template <class Use>
  void for_each_edge(Use use) {
    const auto vertex_count = static_cast<std::uint32_t>(side_begin_.size() - 2);
    std::array<std::uint64_t, 3> different{};  // what matters is whether there are exactly two
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
      for (std::size_t i = side_begin_[v]; i < side_begin_[v + 1];) {
        const std::uint32_t end = larger(sides_[i]);
        std::size_t count = 0;
        for (; i < side_begin_[v + 1] && larger(sides_[i]) == end; ++i) {
          if (count < different.size() && (count == 0 || different[count - 1] != sides_[i]))
            different[count++] = sides_[i];
        }
        use(v, end, std::span<const std::uint64_t>(different).first(count));
      }
    }
  }

  std::vector<std::size_t> side_begin_, ring_begin_, wing_begin_;  ///< [vertex]
  std::vector<std::uint64_t> sides_;
  std::vector<std::uint32_t> rings_;
  std::vector<Wing> wings_;
};

}  // namespace tvg
