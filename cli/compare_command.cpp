#include "cli/commands.hpp"
#include "cli/compared_sides.hpp"
#include "cli/input_options.hpp"
#include "cli/property_report.hpp"
#include "cli/surface_report.hpp"
#include "encoder/importers/open_source.hpp"
#include "encoder/importers/scene_file.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"
#include "tool/origin.hpp"
#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
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
  std::string gaps;
  std::string weld;
  std::uint32_t hausdorff_stride = 0;
  std::uint32_t samples = SurfaceSettings().samples;
  bool surfaces = false;
  bool json = false;
  bool quiet = false;
};

/// The rate a scene is sampled at unless --fps says it: that of the stream it is compared with.
std::string rate_of(const FrameSource& other) {
  const Metadata metadata = other.metadata();
  const auto fps = metadata.find("fps");
  return fps == metadata.end() ? "" : fps->second;
}

/// A stream, a cache with the mesh file named by --mesh, a sequence of mesh files, or a scene.
/// `origin`: what coordinates of mesh files are relative to, where the other side says it.
std::unique_ptr<FrameSource> open_side(const std::string& path, const CompareArguments& arguments,
                                       const std::string& fps, const std::optional<Origin>& origin = {}) {
  if (is_stream_file(path)) return std::make_unique<StreamSource>(path);
  std::string mesh;
  SourceSpec spec{{path}};
  spec.sequence = sequence_options(arguments.gaps, arguments.weld);
  spec.sequence.origin = origin;
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
  if (is_cache_file(path) && mesh.empty()) {
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("{}: a cache has no faces: name its mesh with --mesh (an OBJ, PLY, OFF or STL file)",
                    path));
  }
  if (is_cache_file(path)) spec.inputs = {mesh, path};
  return open_source(spec).source;
}

/// The origin that what is compared with has: mesh files are read relative to the same. A cache does not say.
std::optional<Origin> shared_origin(const std::string& path, const FrameSource& decoded) {
  if (is_cache_file(path)) return std::nullopt;
  const std::optional<Origin> origin = origin_of(decoded.metadata());
  if (!origin)
    throw ToolError(ExitStatus::kInvalidInput, path + ": its metadata `origin` are not three numbers");
  return origin;
}

ComparedSides open_sides(const CompareArguments& arguments) {
  if (!arguments.fps.empty()) static_cast<void>(parse_rate(arguments.fps));
  ComparedSides sides{{}, {}, arguments.original, arguments.decoded, arguments.quiet};
  sides.decoded = open_side(arguments.decoded, arguments, arguments.fps);
  sides.same_properties = is_cache_file(arguments.original) && is_cache_file(arguments.decoded);
  sides.original = open_side(arguments.original, arguments,
                             arguments.fps.empty() ? rate_of(*sides.decoded) : arguments.fps,
                             shared_origin(arguments.decoded, *sides.decoded));
  return sides;
}

nlohmann::json json_of(const ComparisonReport& report) {
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
  return json;
}

PropertyReport properties_together(const std::vector<Stretch>& stretches) {
  std::vector<PropertyReport> reports;
  reports.reserve(stretches.size());
  for (const Stretch& stretch : stretches) reports.push_back(stretch.properties);
  return together(reports);
}

void print_json(const std::vector<Stretch>& stretches) {
  nlohmann::json json = json_of(together(stretches));
  add_to_json(properties_together(stretches), json);
  if (stretches.size() > 1) {
    for (const Stretch& stretch : stretches) {
      nlohmann::json one = json_of(stretch.report);
      one["first_frame"] = stretch.first_frame;
      add_to_json(stretch.properties, one);
      json["stretches"].push_back(std::move(one));
    }
  }
  fmt::print("{}\n", json.dump(2));
}

void print_text(const ComparisonReport& report) {
  fmt::print("{} frames of {} vertices, bounding box diagonal {:.6g}\n", report.frames, report.vertices,
             report.diagonal);
  print_distance("maximum, coordinate", report.max_coordinate_error, report.relative_max_coordinate_error);
  print_distance("maximum, vertex", report.max_vertex_distance, report.relative_max_vertex_distance);
  print_distance("RMS, coordinate", report.rms_coordinate_error, report.relative_rms_coordinate_error);
  print_distance("RMS, vertex", report.rms_vertex_distance, report.relative_rms_vertex_distance);
  fmt::print("  {:<24}{:>14}\n", "worst",
             fmt::format("frame {} vertex {}", report.worst_frame, report.worst_vertex));
  fmt::print("  {:<24}{:>14.2f} dB\n", "SNR", report.snr_db);
  fmt::print("  {:<24}{:>14.5f} %\n", "KG error", report.kg_percent);
  fmt::print("  {:<24}{:>14.6g} mean, {:.6g} maximum\n", "quadric error", report.mean_quadric_error,
             report.max_quadric_error);
  fmt::print("  {:<24}{:>14.6g} spatial {:.6g}, temporal {:.6g}\n", "STED", report.sted, report.sted_spatial,
             report.sted_temporal);
  if (report.hausdorff) {
    print_distance("Hausdorff", *report.hausdorff, report.relative_hausdorff.value_or(0));
    fmt::print("  {:<24}{:>14} frames\n", "  measured at", report.hausdorff_frames);
  }
}

/// Each stretch by itself, and what holds for all.
void print_text(const std::vector<Stretch>& stretches) {
  if (stretches.size() == 1) {
    print_text(stretches[0].report);
    print_property_report(stretches[0].properties);
    return;
  }
  for (const Stretch& stretch : stretches) {
    fmt::print("frames {}-{}: ", stretch.first_frame, stretch.first_frame + stretch.report.frames - 1);
    print_text(stretch.report);
    print_property_report(stretch.properties);
  }
  const ComparisonReport all = together(stretches);
  fmt::print(
      "all {} frames in {} stretches of one mesh: maximum, coordinate {:.6g}; RMS, coordinate {:.6g}\n",
      all.frames, stretches.size(), all.max_coordinate_error, all.rms_coordinate_error);
}

/// So that what was read to no end can be compared in another way.
void begin_again(const ComparedSides& sides) {
  for (const auto& [source, name] : {std::pair(sides.original.get(), &sides.original_name),
                                     std::pair(sides.decoded.get(), &sides.decoded_name)}) {
    if (!source->rewind()) {
      throw ToolError(ExitStatus::kInvalidInput,
                      *name +
                          " comes to have other vertices and cannot be read twice: --surfaces compares "
                          "surfaces from the first frame on");
    }
  }
}

void run_compare(const CompareArguments& arguments) {
  const ComparedSides sides = open_sides(arguments);
  const std::uint32_t stride = std::max(1u, arguments.hausdorff_stride);
  std::optional<std::vector<Stretch>> stretches;
  if (!arguments.surfaces) {
    stretches = compare_vertices(sides, {arguments.hausdorff_stride > 0, stride});
    if (!stretches) begin_again(sides);
  }
  if (!stretches) {
    const SurfaceReport report = compare_surfaces(sides, {arguments.samples, stride});
    return arguments.json ? print_surface_json(report) : print_surface_report(report);
  }
  arguments.json ? print_json(*stretches) : print_text(*stretches);
}

}  // namespace

void add_compare_command(CLI::App& tool) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App& command =
      *tool.add_subcommand("compare",
                           "Measure how far decoded frames lie from the original, vertex by vertex, "
                           "or surface from surface where the meshes differ");
  command
      .add_option("original", arguments->original, "a cache, a sequence of mesh files, a scene, or a .tvg")
      ->required();
  command.add_option("decoded", arguments->decoded, "the same of what was decoded")->required();
  command.add_option(
      "--mesh", arguments->meshes,
      "the mesh of the caches (OBJ, PLY, OFF, STL), or a mesh of a scene by name, as it was encoded; "
      "may be repeated");
  add_sequence_options(command, arguments->gaps, arguments->weld);
  command.add_option("--clip", arguments->clip, "the clip of a scene, as it was encoded");
  command.add_option("--fps", arguments->fps,
                     "sample a scene at this rate (default: that of the decoded stream)");
  command
      .add_option(
          "--hausdorff", arguments->hausdorff_stride,
          "also measure the Hausdorff distance between the surfaces, at every Nth frame (slow); where "
          "the meshes differ, take every Nth frame alone (default: every one)")
      ->check(CLI::PositiveNumber);
  command.add_flag("--surfaces", arguments->surfaces,
                   "compare as surfaces even where the meshes are the same: root mean square and Hausdorff "
                   "distance, in both directions");
  command
      .add_option("--samples", arguments->samples,
                  "points of each surface that are held against the other, spread by area")
      ->check(CLI::Range(1u, 100000000u))
      ->capture_default_str();
  command.add_flag("--json", arguments->json, "print the figures as JSON");
  command.add_flag("-q,--quiet", arguments->quiet, "no progress bar");
  command.callback([arguments] { run_compare(*arguments); });
}

}  // namespace tvg::cli
