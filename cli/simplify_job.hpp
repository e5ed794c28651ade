#pragma once
#include "cli/input_options.hpp"
#include "cli/measure_options.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace tvg::cli {

/// Values of the options of `tvg simplify`.
struct SimplifyArguments {
  InputArguments input;
  std::string output;
  std::optional<double> ratio;
  std::optional<std::uint64_t> vertices;
  CostArguments cost;  ///< `maps` among its criteria stands for Eq. 7
  std::optional<double> lambda;
  bool per_keyframe = false;
  std::optional<std::uint32_t> remesh;  ///< levels
  std::optional<double> remesh_distance;
  std::string bits;
  std::string mode;
  std::string report;
  std::uint32_t memory = 1024;
  std::uint32_t distance_stride = 0;
  bool no_distance = false;
  bool json = false;
  bool quiet = false;

  bool by_maps() const { return cost.criteria == "maps"; }
};

/// Simplifies, writes and reports. Throws ToolError.
void run_simplify(const SimplifyArguments& arguments);

}  // namespace tvg::cli
