#pragma once
#include "prediction/surface_graph.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Finds the nearest places along a graph, best first, with work and memory that no graph raises (format-spec
/// §5.4.3).
class NearestSearch {
 public:
  /// For graphs of up to so many places. False without memory.
  [[nodiscard]] bool reserve(std::uint32_t places);

  /// The nearest places to `from` whose time is before its own, nearest first, of equal ones the lower: at
  /// most `found.size()`, and from kApart on only as many as make kEnough; says how many. Only the first
  /// kLinks links of a place are followed, and only those of the kVisits nearest places, `from` among them.
  std::uint32_t run(const SurfaceGraph& graph, std::span<const std::uint32_t> time, std::uint32_t from,
                    std::span<std::uint32_t> found);

 private:
  static constexpr std::uint32_t kVisits = 96;
  static constexpr std::uint32_t kLinks = 16;
  /// An affine function has four coefficients: with a little more than that, other components do more harm
  /// than good.
  static constexpr std::uint32_t kEnough = 6;

  void follow(const SurfaceGraph& graph, std::uint32_t place, std::uint32_t distance);

  /// [place]: the number of the search, counted down, and the distance found in it. So whatever an earlier
  /// search left is larger than all of this one's.
  std::vector<std::uint64_t> reached_;
  std::vector<Link> queue_;  ///< a heap: distance and place, the least first
  std::uint32_t search_ = ~std::uint32_t{0};
};

}  // namespace tvg
