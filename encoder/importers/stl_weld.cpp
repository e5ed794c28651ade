#include "encoder/importers/stl_weld.hpp"

#include "encoder/importers/corner_weld.hpp"
#include "encoder/importers/facet_match.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

std::vector<float> in_order(const FacetMatch& match, const std::vector<float>& corners) {
  std::vector<float> ordered;
  ordered.reserve(corners.size());
  for (const std::uint32_t corner : match.corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) ordered.push_back(corners[3 * std::size_t{corner} + axis]);
  }
  return ordered;
}

}  // namespace

StlWeld::StlWeld(const std::vector<float>& corners, const WeldTolerance& tolerance)
    : tolerance_(tolerance.value), first_(corners), before_(corners) {
  if (tolerance.of_diagonal) {
    BoundingBox box;
    box.extend(corners);
    tolerance_ *= box.diagonal();
  }
  first_weld_ = weld_within(corners, tolerance_);
  weld_ = first_weld_;
}

std::string StlWeld::order(std::vector<float>& corners, const std::string& first_file) {
  if (corners.size() != first_.size()) {
    return fmt::format("has {} triangles where {} has {}", corners.size() / 9, first_file, first_.size() / 9);
  }
  std::size_t torn = 0;
  if (count_torn(first_weld_, corners, tolerance_, torn) > 0) {
    const Weld own = weld_within(corners, tolerance_);
    if (const auto match = match_facets(before_, first_weld_, corners, own)) {
      corners = in_order(*match, corners);
      reordered_ = true;
    } else if (split_weld(first_weld_, corners, tolerance_).vertex_count() >
               2 * std::max(own.vertex_count(), first_weld_.vertex_count())) {
      // Vertices that really come apart are apart in this frame alone too.
      return fmt::format(
          "has its triangles in another order than {} (corner {} of triangle {} is the first that does not "
          "fit), and which is which cannot be told",
          first_file, torn % 3, torn / 3);
    }
  }
  before_ = corners;
  return "";
}

std::string StlWeld::refine(const MeshFile& frame, const std::string& first_file) {
  std::vector<float> corners = frame.positions;
  std::string other = order(corners, first_file);
  if (!other.empty()) return other;
  std::size_t torn = 0;
  if (count_torn(weld_, corners, tolerance_, torn) > 0) weld_ = split_weld(weld_, corners, tolerance_);
  return "";
}

std::string StlWeld::apply(MeshFile& frame, const std::string& first_file) {
  std::string other = order(frame.positions, first_file);
  if (!other.empty()) return other;
  std::size_t torn = 0;
  if (count_torn(weld_, frame.positions, tolerance_, torn) > 0) {
    return fmt::format("tears corner {} of triangle {} off the corners that share its vertex in {}", torn % 3,
                       torn / 3, first_file);
  }
  apply_weld(weld_, frame);
  return "";
}

}  // namespace tvg::cli
