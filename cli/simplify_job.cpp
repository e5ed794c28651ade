#include "cli/simplify_job.hpp"

#include "cli/frames_in_memory.hpp"
#include "cli/simplified_source.hpp"
#include "cli/simplify_output.hpp"
#include "cli/simplify_report.hpp"
#include "decoder/exporters/frame_sink.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

namespace tvg::cli {

namespace {

constexpr std::uint32_t kLeastVertices = 3;
constexpr std::uint64_t kMegabyte = 1u << 20;
/// Frames at which the distance is measured unless a stride says it: more take longer than simplifying.
constexpr std::uint64_t kUsualMeasuredFrames = 50;

[[noreturn]] void fail_usage(const std::string& message) {
  throw ToolError(ExitStatus::kUsage, message);
}

/// What can be said about the options before any file is opened.
void check_options(const SimplifyArguments& arguments) {
  if (arguments.ratio.has_value() == arguments.vertices.has_value()) {
    fail_usage(arguments.ratio ? "--ratio and --vertices both say how far: give one of them"
                               : "say how far, with --ratio 6 (times fewer vertices) or --vertices 1000");
  }
  if (arguments.vertices.value_or(kLeastVertices) < kLeastVertices)
    fail_option("--vertices", std::to_string(*arguments.vertices),
                fmt::format("a mesh has at least {} vertices", kLeastVertices));
  if (arguments.lambda && !arguments.by_maps())
    fail_usage(
        "--lambda weighs the area against the curvature in --priority maps: other priorities have none");
  if (arguments.by_maps() && !arguments.cost.options.empty()) {
    fail_usage(fmt::format("{} is for criteria, and --priority maps has none",
                           arguments.cost.options.begin()->first));
  }
  if (arguments.by_maps() && arguments.cost.smoothing)
    fail_usage("--smooth is for criteria, and --priority maps has none");
  if (arguments.remesh && arguments.per_keyframe)
    fail_usage("--remesh goes with one mesh for all frames, and --per-keyframe makes one for each");
  if (arguments.remesh_distance && !arguments.remesh)
    fail_usage("--remesh-distance says where --remesh LEVELS cuts: give that too");
  const bool stream = is_stream_file(arguments.output);
  for (const auto& [option, given] :
       {std::pair("--bits", !arguments.bits.empty()), std::pair("--mode", !arguments.mode.empty())}) {
    if (given && !stream)
      fail_usage(fmt::format("{} is for a .tvg, and {} is none", option, arguments.output));
  }
  if (arguments.json && arguments.output == "-")
    fail_usage("--json prints to standard output, where -o - puts the frames: write these to a file");
  if (!arguments.report.empty() && !is_report_file(arguments.report))
    fail_option("--report", arguments.report, "write report.csv, report.json or report.svg");
}

SimplifyOptions options_of(const SimplifyArguments& arguments) {
  SimplifyOptions options;
  if (arguments.by_maps()) {
    options.priority = SimplifyPriority::kMaps;
    options.lambda = arguments.lambda.value_or(options.lambda);
  } else {
    options.importance = importance_of(arguments.cost);
  }
  return options;
}

EncodeOptions encode_options(const SimplifyArguments& arguments, std::uint64_t first_frame) {
  constexpr std::uint32_t kBasisGopFrames = 32;
  EncodeOptions options;
  if (!arguments.bits.empty()) {
    const BitPair bits = parse_bits(arguments.bits);
    if (bits.fine != bits.coarse) {
      fail_option("--bits", arguments.bits,
                  "write one number, as 11; tvg encode has two resolutions and all else there is to choose");
    }
    options.fine_bits = options.coarse_bits = bits.fine;
  }
  if (arguments.mode == "basis") {
    options.mode = Mode::kBasis;
    options.gop_frames = kBasisGopFrames;
  }
  options.threads = std::max(1u, std::thread::hardware_concurrency());
  options.first_frame = first_frame;
  return options;
}

/// Edges that are no inner edge or boundary of a surface: of more than two faces, or of two that are turned
/// against each other.
std::size_t count_broken_edges(const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> sides;  // lower and higher vertex, and whether it goes down
  for (const Face& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = face[k], to = face[(k + 1) % 3];
      if (from != to) sides.push_back({std::min(from, to), std::max(from, to), from > to ? 1u : 0u});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::size_t broken = 0;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end][0] == sides[i][0] && sides[end][1] == sides[i][1]) ++end;
    if (end - i > 2 || (end - i == 2 && sides[i][2] == sides[i + 1][2])) ++broken;
  }
  return broken;
}

void tell_of_locked_vertices(const Mesh& mesh) {
  const std::size_t broken = count_broken_edges(mesh);
  if (broken == 0) return;
  fmt::print(stderr,
             "note: {} {} more than two faces, or faces turned against each other: vertices there stay\n",
             broken, broken == 1 ? "edge has" : "edges have");
}

class SimplifyJob {
 public:
  explicit SimplifyJob(const SimplifyArguments& arguments)
      : arguments_(arguments), names_(input_names(arguments.input)) {
    check_options(arguments);
    options_ = options_of(arguments);
    check_outputs();
    opened_ = open_input_or_stream(arguments.input);
    encode_ = encode_options(arguments, opened_.first_frame);
    if (!arguments.by_maps())
      check_measure(arguments.cost, options_.importance, *opened_.source, arguments.input.inputs);
    if (!arguments.quiet) print_notes(opened_);
    if (!arguments.quiet) tell_of_locked_vertices(opened_.source->mesh());
    options_.vertex_counts = {wanted_vertices()};
    output_ = std::make_unique<SimplifyOutput>(arguments.output, opened_.first_frame);
  }

  void run() {
    hold();
    std::string written;
    if (arguments_.per_keyframe) {
      written = run_per_keyframe();
    } else {
      written = run_whole();
    }
    if (!arguments_.report.empty()) write_simplify_report(arguments_.report, report_);
    if (!arguments_.quiet) {
      print_simplify_report(report_);
      fmt::print(stderr, "{}\n", written);
    }
    if (arguments_.json) {
      fmt::print("{}\n", json_of(report_).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    }
  }

 private:
  void check_outputs() const {
    const InputFiles inputs = files_of(arguments_.input, arguments_.cost.weights());
    inputs.check_output(arguments_.report);
    if (is_stream_file(arguments_.output)) return inputs.check_output(arguments_.output);
    for (const std::string& output : sink_outputs(arguments_.output, {})) inputs.check_output(output);
  }

  std::uint32_t wanted_vertices() const {
    const Mesh& mesh = opened_.source->mesh();
    if (mesh.faces.empty()) {
      throw ToolError(ExitStatus::kInvalidInput,
                      fmt::format("{}: there are no faces, and without them no surface to simplify", names_));
    }
    if (arguments_.vertices) {
      if (*arguments_.vertices > mesh.vertex_count) {
        fail_option("--vertices", std::to_string(*arguments_.vertices),
                    fmt::format("{} has {}: ask for fewer", names_, mesh.vertex_count));
      }
      return static_cast<std::uint32_t>(*arguments_.vertices);
    }
    const double wanted = std::round(mesh.vertex_count / *arguments_.ratio);
    if (wanted < kLeastVertices) {
      fail_option("--ratio", fmt::format("{:g}", *arguments_.ratio),
                  fmt::format("{} has {} vertices, and at least {} must be left: ask for {:g} or less",
                              names_, mesh.vertex_count, kLeastVertices,
                              std::floor(mesh.vertex_count / double{kLeastVertices})));
    }
    return static_cast<std::uint32_t>(wanted);
  }

  void hold() {
    ProgressBar bar("reading", arguments_.quiet);
    const bool joints = !arguments_.by_maps() && uses_skeleton(options_.importance);
    held_ = hold_frames(*opened_.source, {arguments_.memory * kMegabyte, joints, names_}, bar);
    bar.clear();
    if (!held_.all() && arguments_.per_keyframe) {
      fail_usage(
          fmt::format("--per-keyframe: {} frames of {} are more than {} MB hold: raise --memory, or take "
                      "a part of them with --frames",
                      held_.total, names_, arguments_.memory));
    }
    if (!held_.all() && !arguments_.quiet) {
      fmt::print(stderr,
                 "note: {} of {} frames, evenly spread, decide what is removed: all take more than {} MB "
                 "(--memory)\n",
                 held_.numbers.size(), held_.total, arguments_.memory);
    }
    report_.input = names_;
    report_.priority = arguments_.cost.criteria;
    report_.vertices = held_.sequence.mesh.vertex_count;
    report_.faces = held_.sequence.mesh.faces.size();
    report_.wanted_vertices = options_.vertex_counts.front();
    report_.frames = held_.total;
    report_.first_frame = opened_.first_frame;
    report_.per_keyframe = arguments_.per_keyframe;
  }

  Simplification simplified(std::span<const FramePositions> frames,
                            std::span<const std::vector<float>> joints,
                            const SimplifyProgress& progress) const {
    Result<Simplification> made =
        simplify(held_.sequence.mesh, frames, opened_.source->skeleton(), joints, options_, progress);
    if (!made) throw tool_error(names_, made.error());
    return std::move(*made);
  }

  std::vector<std::uint64_t> numbers_in_input(std::vector<std::uint64_t> frames) const {
    for (std::uint64_t& frame : frames) frame += opened_.first_frame;
    return frames;
  }

  std::string run_whole() {
    ProgressBar bar("simplifying", arguments_.quiet, "vertices");
    const Simplification made =
        simplified(held_.sequence.frames, held_.joints,
                   [&bar](std::uint32_t removed, std::uint32_t total) { bar.update(removed, total); });
    bar.clear();
    report_.levels = made.levels;
    add_hierarchy(report_, made, numbers_in_input(held_.numbers));
    tell_of_target(made.meshes.back().mesh.vertex_count);

    SequenceSource in_memory(held_.sequence);
    FrameSource& original = held_.all() ? in_memory : *opened_.source;
    if (!arguments_.remesh) return write_whole({original, made.meshes.back()});
    const Result<Remesh> remeshed = remesh(made, held_.sequence.mesh, held_.sequence.frames,
                                           {*arguments_.remesh, arguments_.remesh_distance});
    if (!remeshed) throw tool_error(names_, remeshed.error());
    report_.remeshed_vertices = remeshed->mesh.vertex_count;
    report_.remeshed_faces = remeshed->mesh.faces.size();
    return write_whole({original, *remeshed});
  }

  /// Writes all frames, and measures how far they are from the original.
  std::string write_whole(SimplifiedSource source) {
    rewind(source);
    ProgressBar writing("writing", arguments_.quiet);
    std::string written = output_->write(source, encode_, writing);
    writing.clear();
    if (!arguments_.no_distance) measure_distance(source);
    return written;
  }

  void rewind(FrameSource& source) const {
    if (!source.rewind()) throw ToolError(ExitStatus::kIo, names_ + ": the input cannot be read again");
  }

  std::uint32_t distance_stride() const {
    if (arguments_.distance_stride > 0) return arguments_.distance_stride;
    return static_cast<std::uint32_t>((held_.total + kUsualMeasuredFrames - 1) / kUsualMeasuredFrames);
  }

  void measure_distance(SimplifiedSource& source) {
    rewind(source);
    SurfaceSettings settings;
    settings.stride = distance_stride();
    SurfaceComparison comparison(held_.sequence.mesh, source.mesh(), settings);
    FramePositions frame(3 * std::size_t{source.mesh().vertex_count});
    ProgressBar bar("comparing", arguments_.quiet);
    for (std::uint64_t number = 0;; ++number) {
      const Result<bool> more = source.read_frame(frame);
      if (!more) throw tool_error(names_, more.error());
      if (!*more) break;
      if (const Status status = comparison.add_frame(source.original_frame(), frame); !status.ok())
        throw tool_error(names_, status.error());
      bar.update(number + 1, held_.total);
    }
    report_.distance = comparison.report();
  }

  /// The paper's experiment: a hierarchy of its own for every frame.
  std::string run_per_keyframe() {
    const Mesh& mesh = held_.sequence.mesh;
    encode_.metadata = held_.sequence.metadata;
    encode_.box = box_around(held_.sequence.frames);
    encode_.max_vertices = mesh.vertex_count;
    encode_.max_faces = static_cast<std::uint32_t>(mesh.faces.size());
    output_->begin(encode_, held_.total);
    SurfaceSettings settings;
    settings.stride = distance_stride();
    SurfaceComparison comparison(mesh, mesh, settings);
    ProgressBar bar("simplifying", arguments_.quiet);
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < held_.sequence.frames.size(); ++i) {
      const FramePositions& frame = held_.sequence.frames[i];
      const auto joints = std::span(held_.joints)
                              .subspan(0, held_.joints.empty() ? 0 : i + 1)
                              .last(held_.joints.empty() ? 0 : 1);
      const Simplification made = simplified({&frame, 1}, joints, {});
      const SimplifiedMesh& simple = made.meshes.back();
      add_hierarchy(report_, made, numbers_in_input({held_.numbers[i]}));
      FramePositions positions(3 * std::size_t{simple.mesh.vertex_count});
      gather(simple.vertices, frame, positions);
      output_->add(simple.mesh, positions);
      most = std::max(most, simple.mesh.vertex_count);
      if (!arguments_.no_distance) {
        comparison.set_other(simple.mesh);
        if (const Status status = comparison.add_frame(frame, positions); !status.ok())
          throw tool_error(names_, status.error());
      }
      bar.update(i + 1, held_.total);
    }
    bar.clear();
    tell_of_target(most);
    if (!arguments_.no_distance) report_.distance = comparison.report();
    return output_->finish();
  }

  void tell_of_target(std::uint32_t vertices) const {
    if (arguments_.quiet || vertices <= report_.wanted_vertices) return;
    fmt::print(
        stderr,
        "note: {} vertices are left where {} were asked for: no other can go without a fold or a tear in "
        "some frame\n",
        vertices, report_.wanted_vertices);
  }

  const SimplifyArguments& arguments_;
  std::string names_;
  SimplifyOptions options_;
  EncodeOptions encode_;
  OpenedInput opened_;
  std::unique_ptr<SimplifyOutput> output_;
  FramesInMemory held_;
  SimplifyReport report_;
};

}  // namespace

void run_simplify(const SimplifyArguments& arguments) {
  SimplifyJob(arguments).run();
}

}  // namespace tvg::cli
