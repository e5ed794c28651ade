#include "cli/encode_job.hpp"

#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/tool_error.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <tvg/metrics.hpp>

namespace tvg::cli {

namespace {

/// To three digits, so that what is said of a bound stays one.
double rounded_up(double bound) {
  const double unit = std::pow(10, std::floor(std::log10(bound)) - 2);
  return std::ceil(bound / unit) * unit;
}

}  // namespace

OpenedInput open_for_encoding(const EncodeArguments& arguments, EncodeOptions& options, InputKinds kinds) {
  OpenedInput opened = kinds == InputKinds::kStreamsToo ? open_input_or_stream(arguments)
                                                        : open_input(arguments, arguments.live);
  options.first_frame = opened.first_frame;
  check_measure(arguments.measure, options.importance, *opened.source, arguments.inputs);
  if (!arguments.quiet) print_notes(opened);
  LevelArguments levels = arguments.levels;
  levels.quiet = arguments.quiet;
  options.levels = simplified_levels(*opened.source, levels, options.importance, input_names(arguments));
  return opened;
}

EncodeReport encode_frames(FrameSource& source, const EncodeOptions& options, const ByteSink& sink,
                           const EncodeArguments& arguments) {
  ProgressBar bar("encoding", arguments.quiet);
  const auto progress = [&bar](std::uint64_t frames, std::optional<std::uint64_t> total) {
    bar.update(frames, total);
  };
  const Result<EncodeReport> report = encode(source, options, sink, progress);
  if (!report) throw tool_error(input_names(arguments), report.error());
  bar.clear();
  return *report;
}

void print_encode_json(const std::string& output, const EncodeReport& report, double seconds) {
  nlohmann::json json = {
      {"file", output},
      {"frames", report.frames},
      {"vertices", report.vertices},
      {"meshes", report.meshes},
      {"gops", report.gops},
      {"bytes", report.bytes},
      {"bits_per_coordinate", bits_per_coordinate(report.bytes, report.vertex_frames, 1)},
      {"ratio", 12 * static_cast<double>(report.vertex_frames) / static_cast<double>(report.bytes)},
      {"largest_error", nullptr},
      {"box_of_each_gop", report.box_of_each_gop},
      {"vertex_order_given_up", report.captured},
      {"polygons_left_out", report.polygons_left_out},
      {"seconds", seconds}};
  if (report.largest_error > 0) json["largest_error"] = report.largest_error;
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_encode_report(const std::string& output, const EncodeReport& report) {
  if (report.box_of_each_gop) {
    fmt::print(stderr, "note: the input can be read only once, so each GOP has a bounding box of its own\n");
  }
  if (report.captured) {
    fmt::print(stderr,
               "note: each frame has a mesh of its own, so the vertex order is given up and frames are coded "
               "by themselves (--keep-order keeps it)\n");
  }
  if (report.polygons_left_out > 0) {
    fmt::print(stderr,
               "note: {} polygons come back as triangles: they are no fans of triangles side by side\n",
               report.polygons_left_out);
  }
  fmt::print(
      stderr, "{}: {} frames of {} in {} GOPs, {} ({:.3f} bits per coordinate, {:.1f} times smaller)\n",
      output, report.frames,
      report.meshes == 1 ? fmt::format("{} vertices", report.vertices)
                         : fmt::format("{} meshes", report.meshes),
      report.gops, readable_bytes(report.bytes), bits_per_coordinate(report.bytes, report.vertex_frames, 1),
      12 * static_cast<double>(report.vertex_frames) / static_cast<double>(report.bytes));
  if (report.largest_error > 0)
    fmt::print(stderr, "no coordinate is off by more than {:.3g}\n", rounded_up(report.largest_error));
}

}  // namespace tvg::cli
