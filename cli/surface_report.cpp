#include "cli/surface_report.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvg::cli {

nlohmann::json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

void print_distance(const char* name, double value, double relative) {
  fmt::print("  {:<24}{:>14.6g}{:>12.5f} % of the diagonal\n", name, value, 100 * relative);
}

void print_surface_report(const SurfaceReport& report) {
  fmt::print("{} frames of surfaces with {} and {} vertices, {} and {} faces, bounding box diagonal {:.6g}\n",
             report.frames, report.original_vertices, report.other_vertices, report.original_faces,
             report.other_faces, report.diagonal);
  print_distance("RMS", report.rms, report.relative_rms);
  print_distance("RMS, worst frame", report.worst_rms, report.relative_worst_rms);
  print_distance("Hausdorff, mean frame", report.mean_hausdorff, report.relative_mean_hausdorff);
  print_distance("Hausdorff", report.hausdorff, report.relative_hausdorff);
  fmt::print("  {:<24}{:>14}\n", "worst",
             fmt::format("frame {}, {} of the Hausdorff distance", report.worst_rms_frame,
                         report.worst_hausdorff_frame));
  if (report.measured.size() < report.frames)
    fmt::print("  {:<24}{:>14} frames\n", "measured at", report.measured.size());
}

nlohmann::json json_of(const SurfaceReport& report) {
  nlohmann::json json = {{"frames", report.frames},
                         {"original_vertices", report.original_vertices},
                         {"other_vertices", report.other_vertices},
                         {"original_faces", report.original_faces},
                         {"other_faces", report.other_faces},
                         {"diagonal", report.diagonal},
                         {"rms", report.rms},
                         {"worst_rms", report.worst_rms},
                         {"mean_hausdorff", report.mean_hausdorff},
                         {"hausdorff", report.hausdorff},
                         {"relative_rms", finite_or_null(report.relative_rms)},
                         {"relative_worst_rms", finite_or_null(report.relative_worst_rms)},
                         {"relative_mean_hausdorff", finite_or_null(report.relative_mean_hausdorff)},
                         {"relative_hausdorff", finite_or_null(report.relative_hausdorff)},
                         {"worst_rms_frame", report.worst_rms_frame},
                         {"worst_hausdorff_frame", report.worst_hausdorff_frame},
                         {"measured", nlohmann::json::array()}};
  for (const SurfaceDistances& frame : report.measured) {
    json["measured"].push_back({{"frame", frame.frame},
                                {"rms_to_other", frame.rms_to_other},
                                {"rms_to_original", frame.rms_to_original},
                                {"hausdorff_to_other", frame.hausdorff_to_other},
                                {"hausdorff_to_original", frame.hausdorff_to_original}});
  }
  return json;
}

void print_surface_json(const SurfaceReport& report) {
  fmt::print("{}\n", json_of(report).dump(2));
}

}  // namespace tvg::cli
