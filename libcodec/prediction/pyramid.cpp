#include "prediction/pyramid.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "prediction/nearest_search.hpp"
#include "prediction/pyramid_weights.hpp"
#include "prediction/surface_graph.hpp"

#include <algorithm>

#include <tvg/levels.hpp>

namespace tvg {

namespace {

/// Builds a pyramid from its finest level to its coarsest, the last turns first.
class Builder {
 public:
  Builder(std::span<const ShapePoint> shape, std::span<const std::uint8_t> given, Pyramid& pyramid)
      : shape_(shape), given_(given), pyramid_(pyramid) {}

  [[nodiscard]] bool run(std::span<const Face> faces) {
    if (!prepare() || !edges_of(faces, shape_, graph_)) return false;
    const std::uint8_t highest = given_.empty() ? 0 : *std::max_element(given_.begin(), given_.end());
    for (std::uint8_t level = highest; level > 0; --level) {
      if (!colour_given(level) || !remove_coloured()) return false;
    }
    const std::size_t derived_after = removals_;
    while (removals_ - derived_after < kMostRemovals && graph_.size() > kBase) {
      if (!colour_all() || !remove_coloured()) return false;
    }
    if (!place_base()) return false;
    std::size_t turn = 0;
    for (std::size_t level = 0; level <= removals_; ++level) {
      const std::size_t end = level == removals_ ? shape_.size() : starts_[removals_ - 1 - level];
      for (; turn < end; ++turn) pyramid_.level[turn] = static_cast<std::uint8_t>(level);
    }
    pyramid_.levels = shape_.empty() ? 0 : static_cast<std::uint32_t>(removals_) + 1;
    return true;
  }

 private:
  static constexpr std::uint32_t kBase = 32;
  static constexpr std::size_t kMostRemovals = 48;

  /// Makes room, and puts the vertices in order of rank.
  bool prepare() {
    const auto count = static_cast<std::uint32_t>(shape_.size());
    const std::uint64_t wide = std::uint64_t{count} * pyramid_.neighbours;
    if (wide > static_cast<std::size_t>(-1)) return false;
    if (!try_resize(pyramid_.order, count) || !try_resize(pyramid_.level, count) ||
        !try_resize(pyramid_.count, count) ||
        !try_resize(pyramid_.neighbour, static_cast<std::size_t>(wide)) ||
        !try_resize(pyramid_.weight, static_cast<std::size_t>(wide)) || !try_resize(by_rank_, count) ||
        !search_.reserve(count))
      return false;
    // Any order would do that has no pattern in space.
    for (std::uint32_t v = 0; v < count; ++v) by_rank_[v] = v;
    std::sort(by_rank_.begin(), by_rank_.end(),
              [](std::uint32_t a, std::uint32_t b) { return a * 0x9E3779B1u < b * 0x9E3779B1u; });
    return true;
  }

  /// What can be spared of the graph has colours from 1 on.
  // format-spec §5.4.2
  bool colour_all() { return colour(graph_, by_rank_, colours_); }

  /// What is of the level given has colours from 1 on, and the rest 0.
  // format-spec §5.4.2
  bool colour_given(std::uint8_t level) {
    std::vector<std::uint32_t> members;
    if (!try_reserve(members, by_rank_.size())) return false;
    for (const std::uint32_t p : by_rank_) {
      if (given_[graph_.vertex[p]] == level) members.push_back(p);
    }
    if (!colour(graph_, members, colours_)) return false;
    for (std::uint32_t& c : colours_) c = c == kNoColour ? 0 : c + 1;
    return true;
  }

  /// Gives the last turns to what has a colour above 0, and leaves the rest of the graph.
  // format-spec §5.4.2
  bool remove_coloured() {
    const std::uint32_t most = *std::max_element(colours_.begin(), colours_.end());
    // Those of colour 1 come last: most have it, and so most have the others around them to be predicted
    // from.
    std::vector<std::uint32_t>& time = colours_;
    std::vector<std::uint32_t> turn;
    if (!try_resize(turn, std::size_t{most} + 2)) return false;
    for (std::uint32_t& t : time) {
      t = t == 0 ? 0 : most + 1 - t;
      ++turn[t + 1];
    }
    for (std::uint32_t t = 1; t <= most; ++t) turn[t] += turn[t - 1];
    for (std::uint32_t p = 0; p < graph_.size(); ++p) {
      if (time[p] != 0) settle(p, turn[time[p]]++);
    }
    SurfaceGraph next;
    if (!contract(graph_, time, next, places_)) return false;
    std::size_t kept = 0;
    for (const std::uint32_t p : by_rank_) {
      if (time[p] == 0) by_rank_[kept++] = places_[p];
    }
    by_rank_.resize(kept);
    graph_ = std::move(next);
    starts_[removals_++] = graph_.size();
    return true;
  }

  bool place_base() {
    if (!try_resize(colours_, graph_.size())) return false;
    for (std::uint32_t i = 0; i < graph_.size(); ++i) colours_[by_rank_[i]] = i;
    for (std::uint32_t i = 0; i < graph_.size(); ++i) settle(by_rank_[i], i);
    return true;
  }

  /// Gives a place of the graph its turn, its neighbours and their weights.
  void settle(std::uint32_t place, std::size_t turn) {
    const std::size_t m = pyramid_.neighbours, at = turn * m;
    std::array<std::uint32_t, kMaxPyramidNeighbours> found;
    std::array<ShapePoint, kMaxPyramidNeighbours> around;
    const std::uint32_t vertex = graph_.vertex[place];
    const std::uint32_t count = search_.run(graph_, colours_, place, std::span(found).first(m));
    for (std::uint32_t i = 0; i < count; ++i) {
      pyramid_.neighbour[at + i] = graph_.vertex[found[i]];
      around[i] = shape_[graph_.vertex[found[i]]];
    }
    pyramid_.order[turn] = vertex;
    pyramid_.count[turn] = static_cast<std::uint8_t>(count);
    if (count > 0)
      krige(shape_[vertex], std::span(around).first(count), std::span(pyramid_.weight).subspan(at, count));
  }

  std::span<const ShapePoint> shape_;
  std::span<const std::uint8_t> given_;
  Pyramid& pyramid_;
  SurfaceGraph graph_;
  NearestSearch search_;
  std::vector<std::uint32_t> by_rank_;  ///< places of the graph
  std::vector<std::uint32_t> colours_;  ///< [place] colour, then time: 0 stays, the rest as their turns come
  std::vector<std::uint32_t> places_;
  std::array<std::size_t, kMostRemovals + kMaxVertexLevels> starts_{};  ///< [removal] the first turn it gave
  std::size_t removals_ = 0;
};

}  // namespace

// format-spec §5.4
Result<Pyramid> build_pyramid(std::span<const Face> faces, std::uint32_t vertex_count,
                              std::span<const ShapePoint> shape, std::uint32_t neighbours,
                              std::span<const std::uint8_t> given) {
  Pyramid pyramid;
  pyramid.neighbours = neighbours;
  Builder builder(shape.first(vertex_count), given, pyramid);
  if (!builder.run(faces)) return out_of_memory();
  return pyramid;
}

}  // namespace tvg
