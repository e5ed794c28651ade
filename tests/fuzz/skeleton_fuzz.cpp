#include "encoder/importers/import_error.hpp"
#include "encoder/importers/skeleton_file.hpp"
#include "fuzz/require.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// The input: the JSON of a skeleton.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using tvg::fuzz::require;
  try {
    const tvg::JointTracks tracks =
        tvg::cli::parse_skeleton("fuzzed", {reinterpret_cast<const char*>(data), size});
    const std::size_t joints = tracks.skeleton.joint_names.size();
    require(joints > 0 && tracks.skeleton.parents.size() == joints && !tracks.frames.empty());
    for (std::size_t i = 0; i < joints; ++i) {
      require(tracks.skeleton.parents[i] < static_cast<std::int64_t>(i) && tracks.skeleton.parents[i] >= -1);
    }
    for (const auto& frame : tracks.frames) {
      require(frame.size() == 3 * joints);
      for (const float value : frame) require(std::isfinite(value));
    }
    for (const std::uint32_t joint : tracks.skeleton.heaviest_joint) require(joint < joints);
  } catch (const tvg::cli::ImportError&) {
    // An answer as good as any.
  }
  return 0;
}
