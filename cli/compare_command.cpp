#include "cli/commands.hpp"
#include "encoder/importers/open_source.hpp"
#include "encoder/importers/scene_file.hpp"
#include "tool/mesh_changes.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"
#include "tool/origin.hpp"
#include "tool/progress.hpp"
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
  std::uint32_t hausdorff_stride = 0;
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

/// What the frames of one mesh have in common.
struct Stretch {
  std::uint64_t first_frame = 0;
  ComparisonReport report;
};

/// Both sides, frame by frame, over changes of the mesh that both have.
class Comparing {
 public:
  Comparing(const CompareArguments& arguments, FrameSource& original, FrameSource& decoded)
      : arguments_(arguments), original_(original), decoded_(decoded), bar_("comparing", arguments.quiet) {}

  std::vector<Stretch> run() {
    for (;;) {
      const std::uint64_t first = frame_;
      SequenceComparison comparison = begin();
      const bool more = compare_stretch(comparison);
      stretches_.push_back({first, comparison.report()});
      if (!more) return std::move(stretches_);
    }
  }

 private:
  enum class Next { kFrame, kMesh, kEnd };

  SequenceComparison begin() {
    const std::uint32_t vertices = original_.mesh().vertex_count;
    if (decoded_.mesh().vertex_count != vertices) {
      throw ToolError(
          ExitStatus::kInvalidInput,
          fmt::format("{} has {} vertices and {} has {}{}: only frames of one mesh can be compared",
                      arguments_.original, vertices, arguments_.decoded, decoded_.mesh().vertex_count,
                      frame_ > 0 ? fmt::format(" from frame {} on", frame_) : ""));
    }
    a_.assign(3 * std::size_t{vertices}, 0);
    b_ = a_;
    return SequenceComparison(original_.mesh(),
                              {arguments_.hausdorff_stride > 0, std::max(1u, arguments_.hausdorff_stride)});
  }

  static Next read(FrameSource& source, FramePositions& frame) {
    const Result<bool> read = source.read_frame(frame);
    if (read) return *read ? Next::kFrame : Next::kEnd;
    auto* changes = dynamic_cast<MeshChanges*>(&source);
    if (changes != nullptr && changes->go_on_with_next_mesh()) return Next::kMesh;
    throw tool_error(read.error());
  }

  /// Compares up to the next mesh (true) or the end.
  bool compare_stretch(SequenceComparison& comparison) {
    for (;; ++frame_) {
      const Next a = read(original_, a_);
      const Next b = read(decoded_, b_);
      if (a != b) fail_apart(a, b);
      if (a != Next::kFrame) return a == Next::kMesh;
      if (Status status = comparison.add_frame(a_, b_); !status.ok())
        throw tool_error(arguments_.decoded, status.error());
      bar_.update(frame_ + 1, original_.frame_count());
    }
  }

  [[noreturn]] void fail_apart(Next a, Next b) const {
    const std::string& ended = a == Next::kEnd ? arguments_.original : arguments_.decoded;
    const std::string& goes_on = a == Next::kEnd ? arguments_.decoded : arguments_.original;
    if (a == Next::kEnd || b == Next::kEnd) {
      throw ToolError(ExitStatus::kInvalidInput,
                      fmt::format("{} ends after {} frames, {} goes on", ended, frame_, goes_on));
    }
    throw ToolError(ExitStatus::kInvalidInput,
                    fmt::format("{} has another mesh from frame {} on, {} has not",
                                a == Next::kMesh ? arguments_.original : arguments_.decoded, frame_,
                                a == Next::kMesh ? arguments_.decoded : arguments_.original));
  }

  const CompareArguments& arguments_;
  FrameSource& original_;
  FrameSource& decoded_;
  ProgressBar bar_;
  FramePositions a_;
  FramePositions b_;
  std::uint64_t frame_ = 0;
  std::vector<Stretch> stretches_;
};

/// The origin that what is compared with has: mesh files are read relative to the same. A cache does not say.
std::optional<Origin> shared_origin(const std::string& path, const FrameSource& decoded) {
  if (is_cache_file(path)) return std::nullopt;
  const std::optional<Origin> origin = origin_of(decoded.metadata());
  if (!origin)
    throw ToolError(ExitStatus::kInvalidInput, path + ": its metadata `origin` are not three numbers");
  return origin;
}

std::vector<Stretch> compare(const CompareArguments& arguments) {
  if (!arguments.fps.empty()) static_cast<void>(parse_rate(arguments.fps));
  const auto decoded = open_side(arguments.decoded, arguments, arguments.fps);
  const auto original =
      open_side(arguments.original, arguments, arguments.fps.empty() ? rate_of(*decoded) : arguments.fps,
                shared_origin(arguments.decoded, *decoded));
  return Comparing(arguments, *original, *decoded).run();
}

/// The figures of all stretches: the largest of what is largest and of what is relative to a mesh, means over
/// all coordinates of what is a mean.
ComparisonReport together(const std::vector<Stretch>& stretches) {
  ComparisonReport all = stretches[0].report;
  if (stretches.size() == 1) return all;
  double weights = 0;
  double squares = 0, vertex_squares = 0, means = 0, quadrics = 0;
  all.frames = 0;
  all.hausdorff_frames = 0;
  for (const Stretch& stretch : stretches) {
    const ComparisonReport& one = stretch.report;
    if (one.max_vertex_distance > all.max_vertex_distance || &stretch == &stretches[0]) {
      all.worst_frame = stretch.first_frame + one.worst_frame;
      all.worst_vertex = one.worst_vertex;
    }
    for (const auto figure :
         {&ComparisonReport::extent, &ComparisonReport::diagonal, &ComparisonReport::max_coordinate_error,
          &ComparisonReport::max_vertex_distance, &ComparisonReport::relative_max_coordinate_error,
          &ComparisonReport::relative_max_vertex_distance, &ComparisonReport::relative_rms_coordinate_error,
          &ComparisonReport::relative_rms_vertex_distance, &ComparisonReport::kg_percent,
          &ComparisonReport::max_quadric_error, &ComparisonReport::sted, &ComparisonReport::sted_spatial,
          &ComparisonReport::sted_temporal}) {
      all.*figure = std::max(all.*figure, one.*figure);
    }
    all.snr_db = std::min(all.snr_db, one.snr_db);
    all.vertices = std::max(all.vertices, one.vertices);
    all.frames += one.frames;
    all.hausdorff_frames += one.hausdorff_frames;
    if (one.hausdorff) all.hausdorff = std::max(all.hausdorff.value_or(0), *one.hausdorff);
    if (one.relative_hausdorff)
      all.relative_hausdorff = std::max(all.relative_hausdorff.value_or(0), *one.relative_hausdorff);
    const double weight = static_cast<double>(one.frames) * static_cast<double>(one.vertices);
    weights += weight;
    squares += weight * one.rms_coordinate_error * one.rms_coordinate_error;
    vertex_squares += weight * one.rms_vertex_distance * one.rms_vertex_distance;
    means += weight * one.mean_coordinate_error;
    quadrics += weight * one.mean_quadric_error;
  }
  all.rms_coordinate_error = std::sqrt(squares / weights);
  all.rms_vertex_distance = std::sqrt(vertex_squares / weights);
  all.mean_coordinate_error = means / weights;
  all.mean_quadric_error = quadrics / weights;
  return all;
}

nlohmann::json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
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

void print_json(const std::vector<Stretch>& stretches) {
  nlohmann::json json = json_of(together(stretches));
  if (stretches.size() > 1) {
    for (const Stretch& stretch : stretches) {
      nlohmann::json one = json_of(stretch.report);
      one["first_frame"] = stretch.first_frame;
      json["stretches"].push_back(std::move(one));
    }
  }
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

/// Each stretch by itself, and what holds for all.
void print_text(const std::vector<Stretch>& stretches) {
  if (stretches.size() == 1) return print_text(stretches[0].report);
  for (const Stretch& stretch : stretches) {
    fmt::print("frames {}-{}: ", stretch.first_frame, stretch.first_frame + stretch.report.frames - 1);
    print_text(stretch.report);
  }
  const ComparisonReport all = together(stretches);
  fmt::print("all {} frames of {} meshes: maximum, coordinate {:.6g}; RMS, coordinate {:.6g}\n", all.frames,
             stretches.size(), all.max_coordinate_error, all.rms_coordinate_error);
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
    const std::vector<Stretch> stretches = compare(*arguments);
    arguments->json ? print_json(stretches) : print_text(stretches);
  });
}

}  // namespace tvg::cli
