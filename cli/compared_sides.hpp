#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/metrics.hpp>
#include <tvg/property_metrics.hpp>
#include <tvg/source.hpp>

namespace tvg::cli {

/// The two sides of a comparison, and how messages name them.
struct ComparedSides {
  std::unique_ptr<FrameSource> original, decoded;
  std::string original_name, decoded_name;
  bool quiet = false;            ///< show no progress
  bool same_properties = false;  ///< both are frames of one mesh file: what else it says, both have
};

/// What the frames of one mesh have in common.
struct Stretch {
  std::uint64_t first_frame = 0;
  ComparisonReport report;
  PropertyReport properties = {};  ///< empty where both sides have those of one file
};

/// Compares both sides frame by frame, over changes of the mesh that both have: a stretch for each mesh.
/// Nothing where their meshes come to have other vertices or faces, so that only surfaces can be compared.
/// Throws ToolError.
std::optional<std::vector<Stretch>> compare_vertices(const ComparedSides& sides,
                                                     const ComparisonSettings& settings);

/// The figures of all stretches: the largest of what is largest and of what is relative to a mesh, means over
/// all coordinates of what is a mean.
ComparisonReport together(const std::vector<Stretch>& stretches);

/// Compares the surfaces of both sides, whose meshes may differ and may change. Throws ToolError.
SurfaceReport compare_surfaces(const ComparedSides& sides, const SurfaceSettings& settings);

}  // namespace tvg::cli
