#include "cli/simplify_report.hpp"

#include "cli/surface_report.hpp"
#include "tool/atomic_file.hpp"
#include "tool/line_plot.hpp"
#include "tool/mesh_format.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// The distances of a frame, ready for a table; empty cells where it was not measured.
std::string distance_cells(const std::map<std::uint64_t, SurfaceDistances>& measured, std::uint64_t frame) {
  const auto found = measured.find(frame);
  if (found == measured.end()) return ",";
  return fmt::format("{:.9g},{:.9g}", found->second.rms(), found->second.hausdorff());
}

/// By the input's numbers.
std::map<std::uint64_t, SurfaceDistances> measured_frames(const SimplifyReport& report) {
  std::map<std::uint64_t, SurfaceDistances> frames;
  if (!report.distance) return frames;
  for (const SurfaceDistances& frame : report.distance->measured)
    frames.emplace(report.first_frame + frame.frame, frame);
  return frames;
}

/// A row for every level and frame that decided; what was measured stands in those of the last level, and has
/// rows without a level for other frames.
std::string csv(const SimplifyReport& report) {
  std::string text = "level,vertices,faces,removed,refused,frame,quadric_error,rms,hausdorff\n";
  std::map<std::uint64_t, SurfaceDistances> measured = measured_frames(report);
  for (std::size_t level = 0; level + 1 < report.levels.size(); ++level) {
    const SimplifyLevel& each = report.levels[level];
    for (std::size_t i = 0; i < report.results.size(); ++i) {
      text += fmt::format("{},{},{},{},{},{},{:.9g},,\n", level + 1, each.vertices, each.faces, each.removed,
                          each.refused, report.results[i].frame, each.quadric_error[i]);
    }
  }
  for (const SimplifiedFrame& frame : report.results) {
    const std::string level = report.levels.empty() ? "" : std::to_string(report.levels.size());
    const std::uint32_t removed =
        report.levels.empty() ? report.vertices - frame.vertices : report.levels.back().removed;
    text += fmt::format("{},{},{},{},{},{},{:.9g},{}\n", level, frame.vertices, frame.faces, removed,
                        report.levels.empty() ? frame.refused : report.levels.back().refused, frame.frame,
                        frame.quadric_error, distance_cells(measured, frame.frame));
    measured.erase(frame.frame);
  }
  for (const auto& [frame, distances] : measured)
    text += fmt::format(",,,,,{},,{}\n", frame, distance_cells(measured, frame));
  return text;
}

std::string svg(const SimplifyReport& report) {
  const std::string title = fmt::format("{}: {} vertices to {}, by {}", report.input, report.vertices,
                                        report.results.front().vertices, report.priority);
  PlotCurve over_frames{"quadric error", {}};
  for (const SimplifiedFrame& frame : report.results)
    over_frames.points.emplace_back(static_cast<double>(frame.frame), frame.quadric_error);
  LinePlot frames{title, {"frame"}, {"quadric error"}, {over_frames}};
  frames.marks = report.results.size() < 40;
  if (report.levels.empty()) return plot_svg({frames});
  PlotCurve mean_error{"mean of the frames", {}}, worst_error{"worst frame", {}};
  for (const SimplifyLevel& level : report.levels) {
    mean_error.points.emplace_back(level.vertices, mean(level.quadric_error));
    worst_error.points.emplace_back(
        level.vertices, *std::max_element(level.quadric_error.begin(), level.quadric_error.end()));
  }
  return plot_svg({frames,
                   {"quadric error after each level",
                    {"vertices left", true},
                    {"quadric error", true},
                    {mean_error, worst_error}}});
}

std::vector<double> quadric_errors(const SimplifyReport& report) {
  std::vector<double> errors;
  for (const SimplifiedFrame& frame : report.results) errors.push_back(frame.quadric_error);
  return errors;
}

std::uint64_t refused(const SimplifyReport& report) {
  std::uint64_t sum = 0;
  for (const SimplifyLevel& level : report.levels) sum += level.refused;
  if (!report.levels.empty()) return sum;
  for (const SimplifiedFrame& frame : report.results) sum += frame.refused;
  return sum;
}

}  // namespace

void add_hierarchy(SimplifyReport& report, const Simplification& made,
                   const std::vector<std::uint64_t>& frames) {
  const Mesh& mesh = made.meshes.back().mesh;
  const std::size_t before = report.results.size();
  for (const std::uint64_t frame : frames)
    report.results.push_back({frame, mesh.vertex_count, static_cast<std::uint32_t>(mesh.faces.size()), 0, 0});
  for (const SimplifyLevel& level : made.levels) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      report.results[before + i].refused += level.refused;
      report.results[before + i].quadric_error = level.quadric_error[i];
    }
  }
}

void print_simplify_report(const SimplifyReport& report) {
  const auto [least, most] =
      std::minmax_element(report.results.begin(), report.results.end(),
                          [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
  const std::string left = least->vertices == most->vertices
                               ? fmt::format("{}", least->vertices)
                               : fmt::format("{} to {}", least->vertices, most->vertices);
  fmt::print(stderr, "{}: {} of {} vertices ({:.2f} times fewer), {} of {} faces, by {}{}\n", report.input,
             left, report.vertices, static_cast<double>(report.vertices) / most->vertices, most->faces,
             report.faces, report.priority, report.per_keyframe ? ", each frame by itself" : "");
  if (!report.levels.empty())
    fmt::print(stderr, "  {} levels, {} removals refused\n", report.levels.size(), refused(report));
  const std::vector<double> errors = quadric_errors(report);
  const auto worst = std::max_element(errors.begin(), errors.end());
  fmt::print(stderr, "  quadric error {:.6g}, worst {:.6g} (frame {})\n", mean(errors), *worst,
             report.results[static_cast<std::size_t>(worst - errors.begin())].frame);
  if (report.remeshed_vertices > 0)
    fmt::print(stderr, "  remeshed to {} vertices, {} faces\n", report.remeshed_vertices,
               report.remeshed_faces);
  if (!report.distance) return;
  const SurfaceReport& distance = *report.distance;
  const auto line = [&report](const char* name, double usual, double highest, std::uint64_t frame) {
    fmt::print(stderr, "  {} {:.4f} % of the diagonal, worst {:.4f} % (frame {})\n", name, 100 * usual,
               100 * highest, report.first_frame + frame);
  };
  line("RMS distance", distance.relative_rms, distance.relative_worst_rms, distance.worst_rms_frame);
  line("Hausdorff distance", distance.relative_mean_hausdorff, distance.relative_hausdorff,
       distance.worst_hausdorff_frame);
  if (distance.measured.size() < distance.frames)
    fmt::print(stderr, "  distances measured at {} of {} frames\n", distance.measured.size(),
               distance.frames);
}

nlohmann::json json_of(const SimplifyReport& report) {
  const std::vector<double> errors = quadric_errors(report);
  nlohmann::json json = {{"input", report.input},
                         {"priority", report.priority},
                         {"original_vertices", report.vertices},
                         {"original_faces", report.faces},
                         {"wanted_vertices", report.wanted_vertices},
                         {"vertices", report.results.front().vertices},
                         {"faces", report.results.front().faces},
                         {"frames", report.frames},
                         {"first_frame", report.first_frame},
                         {"per_keyframe", report.per_keyframe},
                         {"remeshed_vertices", nullptr},
                         {"remeshed_faces", nullptr},
                         {"refused", refused(report)},
                         {"mean_quadric_error", mean(errors)},
                         {"max_quadric_error", *std::max_element(errors.begin(), errors.end())},
                         {"levels", nlohmann::json::array()},
                         {"results", nlohmann::json::array()},
                         {"distance", nullptr}};
  for (const SimplifyLevel& level : report.levels) {
    json["levels"].push_back({{"vertices", level.vertices},
                              {"faces", level.faces},
                              {"removed", level.removed},
                              {"refused", level.refused},
                              {"quadric_error", level.quadric_error}});
  }
  for (const SimplifiedFrame& frame : report.results) {
    json["results"].push_back({{"frame", frame.frame},
                               {"vertices", frame.vertices},
                               {"faces", frame.faces},
                               {"refused", frame.refused},
                               {"quadric_error", frame.quadric_error}});
  }
  if (report.remeshed_vertices > 0) {
    json["remeshed_vertices"] = report.remeshed_vertices;
    json["remeshed_faces"] = report.remeshed_faces;
  }
  if (report.distance) json["distance"] = json_of(*report.distance);
  return json;
}

bool is_report_file(const std::string& path) {
  return has_suffix(path, ".csv") || has_suffix(path, ".json") || has_suffix(path, ".svg");
}

void write_simplify_report(const std::string& path, const SimplifyReport& report) {
  AtomicFile file(path);
  if (has_suffix(path, ".csv")) {
    file.write(csv(report));
  } else if (has_suffix(path, ".svg")) {
    file.write(svg(report));
  } else {
    file.write(json_of(report).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  file.finish();
}

}  // namespace tvg::cli
