#include "cli/commands.hpp"
#include "encoder/importers/open_source.hpp"
#include "encoder/importers/scene_file.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

#include <tvg/metrics.hpp>

namespace tvg::cli {

namespace {

struct CompareArguments {
  std::string original;
  std::string decoded;
  std::vector<std::string> meshes;
  std::string clip;
  std::string fps;
  std::uint32_t hausdorff_stride = 0;
  bool json = false;
  bool quiet = false;
};

bool is_cache(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension().string();
  return suffix == ".pc2" || suffix == ".mdd";
}

/// The rate a scene is sampled at unless --fps says it: that of the stream it is compared with.
std::string rate_of(const FrameSource& other) {
  const Metadata metadata = other.metadata();
  const auto fps = metadata.find("fps");
  return fps == metadata.end() ? "" : fps->second;
}

/// A stream, a cache with the mesh file named by --mesh, a sequence of mesh files, or a scene.
std::unique_ptr<FrameSource> open_side(const std::string& path, const CompareArguments& arguments,
                                       const std::string& fps) {
  if (is_stream_file(path)) return std::make_unique<StreamSource>(path);
  std::string mesh;
  SourceSpec spec{{path}};
  for (const std::string& name : arguments.meshes) {
    if (mesh_format(name)) {
      mesh = name;
    } else if (is_scene(path)) {
      spec.scene.meshes.push_back(name);
    }
  }
  if (is_scene(path)) {
    spec.scene.clip = arguments.clip;
    spec.scene.fps = fps;
  }
  if (is_cache(path) && mesh.empty()) {
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("{}: a cache has no faces: name its mesh with --mesh (an OBJ, PLY, OFF or STL file)",
                    path));
  }
  if (is_cache(path)) spec.inputs = {mesh, path};
  return open_source(spec).source;
}

Result<bool> read(FrameSource& source, FramePositions& frame) {
  Result<bool> read = source.read_frame(frame);
  if (!read) throw tool_error(read.error());
  return read;
}

ComparisonReport compare(const CompareArguments& arguments) {
  if (!arguments.fps.empty()) static_cast<void>(parse_rate(arguments.fps));
  const auto decoded = open_side(arguments.decoded, arguments, arguments.fps);
  const auto original =
      open_side(arguments.original, arguments, arguments.fps.empty() ? rate_of(*decoded) : arguments.fps);
  const std::uint32_t vertices = original->mesh().vertex_count;
  if (decoded->mesh().vertex_count != vertices) {
    throw ToolError(
        ExitStatus::kInvalidInput,
        fmt::format("{} has {} vertices and {} has {}: only frames of one mesh can be compared",
                    arguments.original, vertices, arguments.decoded, decoded->mesh().vertex_count));
  }
  SequenceComparison comparison(original->mesh(),
                                {arguments.hausdorff_stride > 0, std::max(1u, arguments.hausdorff_stride)});
  FramePositions a(3 * std::size_t{vertices});
  FramePositions b(a.size());
  ProgressBar bar("comparing", arguments.quiet);
  for (std::uint64_t frame = 0;; ++frame) {
    const bool more_a = *read(*original, a);
    const bool more_b = *read(*decoded, b);
    if (more_a != more_b) {
      throw ToolError(
          ExitStatus::kInvalidInput,
          fmt::format("{} ends after {} frames, {} goes on", more_a ? arguments.decoded : arguments.original,
                      frame, more_a ? arguments.original : arguments.decoded));
    }
    if (!more_a) break;
    if (Status status = comparison.add_frame(a, b); !status.ok())
      throw tool_error(arguments.decoded, status.error());
    bar.update(frame + 1, original->frame_count());
  }
  return comparison.report();
}

nlohmann::json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

void print_json(const ComparisonReport& report) {
  nlohmann::json json = {
      {"frames", report.frames},
      {"vertices", report.vertices},
      {"extent", report.extent},
      {"diagonal", report.diagonal},
      {"max_coordinate_error", report.max_coordinate_error},
      {"max_vertex_distance", report.max_vertex_distance},
      {"rms_coordinate_error", report.rms_coordinate_error},
      {"rms_vertex_distance", report.rms_vertex_distance},
      {"mean_coordinate_error", report.mean_coordinate_error},
      {"relative_max_coordinate_error", finite_or_null(report.relative_max_coordinate_error)},
      {"relative_max_vertex_distance", finite_or_null(report.relative_max_vertex_distance)},
      {"relative_rms_coordinate_error", finite_or_null(report.relative_rms_coordinate_error)},
      {"relative_rms_vertex_distance", finite_or_null(report.relative_rms_vertex_distance)},
      {"worst_frame", report.worst_frame},
      {"worst_vertex", report.worst_vertex},
      {"snr_db", finite_or_null(report.snr_db)},
      {"kg_percent", finite_or_null(report.kg_percent)},
      {"mean_quadric_error", report.mean_quadric_error},
      {"max_quadric_error", report.max_quadric_error},
      {"sted", report.sted},
      {"sted_spatial", report.sted_spatial},
      {"sted_temporal", report.sted_temporal},
      {"hausdorff", nullptr},
      {"relative_hausdorff", nullptr},
      {"hausdorff_frames", report.hausdorff_frames}};
  if (report.hausdorff) json["hausdorff"] = *report.hausdorff;
  if (report.relative_hausdorff) json["relative_hausdorff"] = *report.relative_hausdorff;
  fmt::print("{}\n", json.dump(2));
}

void print_text(const ComparisonReport& report) {
  fmt::print("{} frames of {} vertices, bounding box diagonal {:.6g}\n", report.frames, report.vertices,
             report.diagonal);
  const auto line = [](const char* name, double value, double relative) {
    fmt::print("  {:<24}{:>14.6g}{:>12.5f} % of the diagonal\n", name, value, 100 * relative);
  };
  line("maximum, coordinate", report.max_coordinate_error, report.relative_max_coordinate_error);
  line("maximum, vertex", report.max_vertex_distance, report.relative_max_vertex_distance);
  line("RMS, coordinate", report.rms_coordinate_error, report.relative_rms_coordinate_error);
  line("RMS, vertex", report.rms_vertex_distance, report.relative_rms_vertex_distance);
  fmt::print("  {:<24}{:>14}\n", "worst",
             fmt::format("frame {} vertex {}", report.worst_frame, report.worst_vertex));
  fmt::print("  {:<24}{:>14.2f} dB\n", "SNR", report.snr_db);
  fmt::print("  {:<24}{:>14.5f} %\n", "KG error", report.kg_percent);
  fmt::print("  {:<24}{:>14.6g} mean, {:.6g} maximum\n", "quadric error", report.mean_quadric_error,
             report.max_quadric_error);
  fmt::print("  {:<24}{:>14.6g} spatial {:.6g}, temporal {:.6g}\n", "STED", report.sted, report.sted_spatial,
             report.sted_temporal);
  if (report.hausdorff) {
    line("Hausdorff", *report.hausdorff, report.relative_hausdorff.value_or(0));
    fmt::print("  {:<24}{:>14} frames\n", "  measured at", report.hausdorff_frames);
  }
}

}  // namespace

void add_compare_command(CLI::App& tool) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App& command = *tool.add_subcommand("compare", "Measure how far decoded frames lie from the original");
  command
      .add_option("original", arguments->original, "a cache, a sequence of mesh files, a scene, or a .tvg")
      ->required();
  command.add_option("decoded", arguments->decoded, "the same of what was decoded")->required();
  command.add_option(
      "--mesh", arguments->meshes,
      "the mesh of the caches (OBJ, PLY, OFF, STL), or a mesh of a scene by name, as it was encoded; "
      "may be repeated");
  command.add_option("--clip", arguments->clip, "the clip of a scene, as it was encoded");
  command.add_option("--fps", arguments->fps,
                     "sample a scene at this rate (default: that of the decoded stream)");
  command
      .add_option("--hausdorff", arguments->hausdorff_stride,
                  "also measure the Hausdorff distance between the surfaces, at every Nth frame (slow)")
      ->check(CLI::PositiveNumber);
  command.add_flag("--json", arguments->json, "print the figures as JSON");
  command.add_flag("-q,--quiet", arguments->quiet, "no progress bar");
  command.callback([arguments] {
    const ComparisonReport report = compare(*arguments);
    arguments->json ? print_json(report) : print_text(report);
  });
}

}  // namespace tvg::cli
