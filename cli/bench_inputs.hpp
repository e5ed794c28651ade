#pragma once
#include <string>
#include <vector>

namespace tvg::cli {

/// The inputs of one animation, as `tvg encode` takes them.
struct BenchInput {
  /// "crane" of crane.obj and crane.pc2; its first file where others would be called the same.
  std::string name;
  std::vector<std::string> files;  ///< not empty
};

/// Which of the inputs are one animation: a cache goes with the mesh of its name, else with the mesh before
/// it, else with the one after it; all others are one each. Throws ToolError (kUsage) where
/// several are frames of one sequence.
std::vector<BenchInput> group_inputs(const std::vector<std::string>& inputs);

}  // namespace tvg::cli
