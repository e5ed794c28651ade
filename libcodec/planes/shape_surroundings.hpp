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
/// (format-spec §5.3.1). They depend on which faces there are, not on their order.
class ShapeSurroundings {
  /// A side of a face, at one end of its edge: the other end, and the face's third corner.
  struct Side {
    std::uint32_t end, third;
  };

 public:
  /// A face (a, b, v) and the vertex o of the one other face at the edge from a to b: v lies near a + b - o.
  struct Wing {
    std::uint32_t a, b, o;
  };

  /// What making it takes at most, for each vertex and each face.
  static constexpr std::size_t kBytesPerVertex = 3 * sizeof(std::size_t);
  static constexpr std::size_t kBytesPerFace =
      3 * sizeof(Side) + 3 * sizeof(Wing) + 6 * sizeof(std::uint32_t);

  /// Every index in `faces` is below `vertex_count`.
  ShapeSurroundings(std::span<const Face> faces, std::uint32_t vertex_count) {
    collect_sides(faces, vertex_count);
    ring_begin_.assign(std::size_t{vertex_count} + 2, 0);
    wing_begin_.assign(std::size_t{vertex_count} + 2, 0);
    for_each_edge([this](std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> thirds) {
      ++ring_begin_[std::size_t{a} + 2];
      ++ring_begin_[std::size_t{b} + 2];
      if (thirds.size() != 2) return;
      for (const std::uint32_t v : thirds) ++wing_begin_[std::size_t{v} + 2];
    });
    for (auto* begin : {&ring_begin_, &wing_begin_}) sum_up(*begin);
    rings_.resize(ring_begin_.back());
    wings_.resize(wing_begin_.back());
    for_each_edge([this](std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> thirds) {
      rings_[ring_begin_[std::size_t{a} + 1]++] = b;
      rings_[ring_begin_[std::size_t{b} + 1]++] = a;
      if (thirds.size() != 2) return;
      wings_[wing_begin_[std::size_t{thirds[0]} + 1]++] = {a, b, thirds[1]};
      wings_[wing_begin_[std::size_t{thirds[1]} + 1]++] = {a, b, thirds[0]};
    });
    sides_ = std::vector<Side>();  // frees what {} would keep
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
  /// Counts at [v + 2] become places at [v + 1], which filling moves on to where v + 1 begins.
  static void sum_up(std::vector<std::size_t>& begin) {
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  }

  /// The sides of all faces with three different corners, by the edge's smaller end, then the larger: sorted
  /// by counting, the larger first.
  void collect_sides(std::span<const Face> faces, std::uint32_t vertex_count) {
    std::vector<std::size_t> by_larger(std::size_t{vertex_count} + 2, 0);
    side_begin_.assign(std::size_t{vertex_count} + 2, 0);
    for_each_side(faces, [&](std::uint32_t smaller, std::uint32_t larger, std::uint32_t /*third*/) {
      ++side_begin_[std::size_t{smaller} + 2];
      ++by_larger[std::size_t{larger} + 2];
    });
    sum_up(by_larger);
    sum_up(side_begin_);
    std::vector<Side> sides(by_larger.back());
    for_each_side(faces, [&](std::uint32_t smaller, std::uint32_t larger, std::uint32_t third) {
      sides[by_larger[std::size_t{larger} + 1]++] = {smaller, third};
    });
    sides_.resize(sides.size());
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
      for (std::size_t i = by_larger[v]; i < by_larger[v + 1]; ++i)
        sides_[side_begin_[std::size_t{sides[i].end} + 1]++] = {v, sides[i].third};
    }
  }

  template <class Use>
  static void for_each_side(std::span<const Face> faces, Use use) {
    for (const Face& face : faces) {
      const auto [x, y, z] = sorted(face);
      if (x == y || y == z) continue;
      use(x, y, z);
      use(x, z, y);
      use(y, z, x);
    }
  }

  static Face sorted(Face face) {
    if (face[0] > face[1]) std::swap(face[0], face[1]);
    if (face[1] > face[2]) std::swap(face[1], face[2]);
    if (face[0] > face[1]) std::swap(face[0], face[1]);
    return face;
  }

  /// Calls `use` with each edge, by ascending ends, and the third corners of its faces, each once, up to
  /// three of them: what matters is whether there are two.
  template <class Use>
  void for_each_edge(Use use) {
    const auto vertex_count = static_cast<std::uint32_t>(side_begin_.size() - 2);
    std::array<std::uint32_t, 3> thirds{};
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
      for (std::size_t i = side_begin_[v]; i < side_begin_[v + 1];) {
        const std::size_t first = i;
        const std::uint32_t end = sides_[first].end;
        do ++i;
        while (i < side_begin_[v + 1] && sides_[i].end == end);
        use(v, end, different_thirds(first, i, thirds));
      }
    }
  }

  std::span<const std::uint32_t> different_thirds(std::size_t begin, std::size_t end,
                                                  std::array<std::uint32_t, 3>& thirds) const {
    std::size_t count = 1;
    thirds[0] = sides_[begin].third;
    for (std::size_t i = begin + 1; i < end && count < thirds.size(); ++i) {
      thirds[count] = sides_[i].third;
      if (thirds[count] != thirds[0] && (count == 1 || thirds[2] != thirds[1])) ++count;
    }
    return std::span(thirds).first(count);
  }

  std::vector<std::size_t> side_begin_, ring_begin_, wing_begin_;  ///< [vertex]
  std::vector<Side> sides_;
  std::vector<std::uint32_t> rings_;
  std::vector<Wing> wings_;
};

}  // namespace tvg
