#include "cli/level_options.hpp"

#include "cli/frames_in_memory.hpp"
#include "cli/number_option.hpp"
#include "tool/progress.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include <tvg/simplify.hpp>

namespace tvg::cli {

namespace {

constexpr double kUsualRatio = 4;
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
/// Vertices of the coarsest mesh that --lod makes.
constexpr double kLeastLodVertices = 8;
/// Where levels end: what is left is one level.
constexpr double kLeastCore = 16, kCoreShare = 1024;

/// How many vertices the coarser meshes have, and then how many the last level.
std::vector<std::uint32_t> vertex_counts(const LevelArguments& arguments, double vertices,
                                         const std::string& names) {
  std::vector<std::uint32_t> counts;
  const double ratio = arguments.lod_ratio.value_or(kUsualRatio);
  double wanted = vertices;
  for (std::uint32_t lod = 0; lod < arguments.lods; ++lod) {
    wanted = std::floor(wanted / ratio);
    if (wanted < kLeastLodVertices || (!counts.empty() && wanted >= counts.back())) {
      fail_option(
          "--lod", std::to_string(arguments.lods),
          fmt::format("{} has {} vertices, enough for {} coarser meshes each {:g} times smaller: ask for "
                      "fewer, or a smaller --lod-ratio",
                      names, vertices, lod, ratio));
    }
    counts.push_back(static_cast<std::uint32_t>(wanted));
  }
  const auto last =
      static_cast<std::uint32_t>(std::min(vertices, std::max(kLeastCore, std::floor(vertices / kCoreShare))));
  if (counts.empty() || last < counts.back()) counts.push_back(last);
  return counts;
}

}  // namespace

void add_level_options(CLI::App& command, LevelArguments& arguments) {
  command
      .add_option("--levels", arguments.levels,
                  "what the pyramid's levels come from: own (distances alone), or simplify, which keeps what "
                  "matters to the animation to the last")
      ->check(CLI::IsMember({"own", "simplify"}))
      ->capture_default_str();
  command
      .add_option("--lod", arguments.lods,
                  "keep so many coarser meshes, that are played from fewer bytes (play and render --lod); "
                  "implies --levels simplify")
      ->check(CLI::Range(1u, kMaxCoarseMeshes));
  add_number(
      command, "--lod-ratio", {1, 1000, true}, [&arguments](double ratio) { arguments.lod_ratio = ratio; },
      fmt::format("how many times fewer vertices each has than the one before (default {:g})", kUsualRatio));
}

std::shared_ptr<const MeshLevels> simplified_levels(FrameSource& source, const LevelArguments& arguments,
                                                    const Importance& importance, const std::string& names) {
  if (arguments.lod_ratio && arguments.lods == 0)
    throw ToolError(ExitStatus::kUsage, "--lod-ratio is for coarser meshes: say how many with --lod 3");
  if (!arguments.any()) return nullptr;
  SimplifyOptions options;
  options.importance = importance;
  options.vertex_counts = vertex_counts(arguments, source.mesh().vertex_count, names);
  ProgressBar reading("reading", arguments.quiet);
  const FramesInMemory held = hold_frames(source, {kMostBytes, uses_skeleton(importance), names}, reading);
  reading.clear();
  if (!source.rewind()) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("--levels simplify and --lod look at the frames before they are encoded, and "
                                "{} can be read only once: write it to a file first",
                                names));
  }
  ProgressBar bar("simplifying", arguments.quiet, "vertices");
  Result<Simplification> made =
      simplify(held.sequence.mesh, held.sequence.frames, source.skeleton(), held.joints, options,
               [&bar](std::uint32_t removed, std::uint32_t total) { bar.update(removed, total); });
  if (!made) throw tool_error(names, made.error());
  bar.clear();
  if (made->mesh_levels.coarse.size() > arguments.lods) made->mesh_levels.coarse.resize(arguments.lods);
  if (made->mesh_levels.coarse.size() < arguments.lods && !arguments.quiet) {
    fmt::print(stderr,
               "note: {} coarser meshes where {} were asked for: no more vertices can go without a fold\n",
               made->mesh_levels.coarse.size(), arguments.lods);
  }
  return std::make_shared<const MeshLevels>(std::move(made->mesh_levels));
}

}  // namespace tvg::cli
