#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tvg/geometry.hpp>

namespace tvg::cli {

/// How the corners of a frame of triangle soup are those of the frame before it, in another order.
struct FacetMatch {
  /// [corner of the frame before]: the corner of the frame. A facet's corners stay together and in their
  /// turning order.
  std::vector<std::uint32_t> corner;
};

/// Finds the order in which the facets of `frame` ([corner][xyz]) stand in `before`, by what hangs together
/// in both: vertex by vertex the welds `before_weld` and `frame_weld` must be one. Each piece is told by the
/// facet that lies nearest. Nothing where the two are different meshes, or where two orders are as good.
std::optional<FacetMatch> match_facets(std::span<const float> before, const Weld& before_weld,
                                       std::span<const float> frame, const Weld& frame_weld);

}  // namespace tvg::cli
