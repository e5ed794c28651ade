#include "geometry/half_edges_encode.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tvg {
namespace {

std::uint32_t corner(const Mesh& mesh, std::uint32_t half_edge, std::uint32_t step) {
  return mesh.faces[half_edge / 3][(half_edge % 3 + step) % 3];
}

bool is_degenerate(const Face& face) {
  return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

/// Calls visit(low, high, id) for every half-edge whose ends differ.
template <class Visit>
void for_each_half_edge(const Mesh& mesh, Visit&& visit) {
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t from = face[c], to = face[c == 2 ? 0 : c + 1];
      if (from != to) visit(std::min(from, to), std::max(from, to), 3 * f + c);
    }
  }
}

/// What pairing keeps from edge to edge, so that memory is reused.
class EdgePairing {
 public:
  explicit EdgePairing(const Mesh& mesh) : mesh_(mesh), partner_(3 * mesh.faces.size(), kNoHalfEdge) {}

  /// Pairs the half-edges of one edge, ascending by id.
  void pair(const HalfEdge* begin, const HalfEdge* end) {
    up_.clear();
    down_.clear();
    for (; begin != end; ++begin) {
      if (is_degenerate(mesh_.faces[begin->id / 3])) continue;
      (corner(mesh_, begin->id, 0) == begin->low ? up_ : down_).push_back(begin->id);
    }
    const std::size_t count = std::min(up_.size(), down_.size());
    for (std::size_t i = 0; i < count; ++i) {
      // A sheet and its back side, both in the mesh, share every edge: the first choice is never a face's own
      // back.
      for (std::size_t j = i; j < std::min(down_.size(), i + 4); ++j) {
        if (corner(mesh_, up_[i], 2) != corner(mesh_, down_[j], 2)) {
          std::swap(down_[i], down_[j]);
          break;
        }
      }
      partner_[up_[i]] = down_[i];
      partner_[down_[i]] = up_[i];
    }
  }

  std::vector<std::uint32_t> take() { return std::move(partner_); }

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> partner_;
  std::vector<std::uint32_t> up_, down_;  ///< half-edges that run from low to high, and back
};

}  // namespace

std::vector<HalfEdge> half_edges_by_edge(const Mesh& mesh) {
  // Two counting sorts that keep the order of what is equal: by the higher end, then by the lower.
  struct Entry {
    std::uint32_t low, id;
  };
  std::vector<std::size_t> high_begin(mesh.vertex_count + std::size_t{2}), low_begin(high_begin.size());
  for_each_half_edge(mesh, [&](std::uint32_t low, std::uint32_t high, std::uint32_t) {
    ++high_begin[high + std::size_t{2}];
    ++low_begin[low + std::size_t{2}];
  });
  std::partial_sum(high_begin.begin(), high_begin.end(), high_begin.begin());
  std::partial_sum(low_begin.begin(), low_begin.end(), low_begin.begin());

  // begin[v + 1] runs from the first place of v to its end, which is where v + 1 begins.
  std::vector<Entry> by_high(high_begin.back());
  for_each_half_edge(mesh, [&](std::uint32_t low, std::uint32_t high, std::uint32_t id) {
    by_high[high_begin[high + std::size_t{1}]++] = {low, id};
  });
  std::vector<HalfEdge> sorted(by_high.size());
  for (std::uint32_t high = 0; high < mesh.vertex_count; ++high) {
    for (std::size_t i = high_begin[high]; i < high_begin[high + std::size_t{1}]; ++i) {
      const auto [low, id] = by_high[i];
      sorted[low_begin[low + std::size_t{1}]++] = {low, high, id};
    }
  }
  return sorted;
}

std::vector<std::uint32_t> pair_half_edges(const Mesh& mesh) {
  const std::vector<HalfEdge> sorted = half_edges_by_edge(mesh);
  EdgePairing pairing(mesh);
  const HalfEdge* const end = sorted.data() + sorted.size();
  for (const HalfEdge *first = sorted.data(), *next = first; first != end; first = next) {
    while (next != end && next->same_edge(*first)) ++next;
    pairing.pair(first, next);
  }
  return pairing.take();
}

}  // namespace tvg
