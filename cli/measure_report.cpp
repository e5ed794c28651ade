#include "cli/measure_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

double share_of(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

/// Changes of angles lie between frames, so that one frame has none.
double per_frame(double angle_sum, std::uint64_t measured_frames) {
  return measured_frames > 1 ? angle_sum / static_cast<double>(measured_frames - 1) : 0.0;
}

/// A histogram in one word: a bar per bin, the highest for the fullest bin, none for an empty one.
std::string bars(const std::vector<std::uint64_t>& counts) {
  constexpr std::array<const char*, 8> kBars = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  const std::uint64_t fullest = *std::max_element(counts.begin(), counts.end());
  std::string text;
  for (const std::uint64_t count : counts) {
    const auto height = static_cast<std::size_t>(std::lround(share_of(count, fullest) * (kBars.size() - 1)));
    text += count > 0 ? kBars[height] : " ";
  }
  return text;
}

std::string frames_of(const MeasureReport& report, const GopStatistics& gop) {
  const std::uint64_t first = report.first_frame + gop.first_frame;
  return fmt::format("{}-{}", first, first + gop.frame_count - 1);
}

/// How vertices are marked: "35 % important", "important above a cost of 0.2".
std::string marking(const Importance& importance) {
  if (importance.threshold) return fmt::format("important above a cost of {:g}", *importance.threshold);
  return fmt::format("{:g} % important", 100 * importance.share);
}

void print_gops(const MeasureReport& report) {
  fmt::print("\nGOPs\n  {:>11} {:>18} {:>9} {:>10} {:>10} {:>10} {:>10}  {}\n", "frames", "important",
             "changed", "cost from", "median", "mean", "largest", "histogram of the cost");
  for (std::size_t i = 0; i < report.gops.size(); ++i) {
    const GopStatistics& gop = report.gops[i];
    fmt::print("  {:>11} {:>9} {:>6.1f} % {:>9} {:>10} {:>10.4g} {:>10.4g} {:>10.4g}  |{}|\n",
               frames_of(report, gop), gop.important, 100 * share_of(gop.important, report.vertices),
               i == 0 ? "-" : fmt::format("{:.1f} %", 100 * share_of(gop.changed, report.vertices)),
               gop.lowest_important ? fmt::format("{:.4g}", *gop.lowest_important) : "-", gop.median,
               gop.mean, gop.largest, bars(gop.histogram.counts));
  }
  fmt::print(
      "  cost from: the lowest of an important vertex; changed: flags that differ from the GOP before;\n"
      "  the histogram reaches from the smallest cost to that of 99 % of the vertices\n");
}

/// What the GOPs say of a joint, together.
struct JointSummary {
  double angle_sum = 0;
  double strongest = 0;  ///< degrees per frame, in the GOP where they are most
  std::size_t dynamic = 0;
};

void print_joints(const MeasureReport& report) {
  std::uint64_t steps = 0;  // from frame to frame within GOPs
  for (const GopStatistics& gop : report.gops) steps += gop.measured_frames - 1;
  std::size_t width = 5;
  for (const std::string& name : report.skeleton.joint_names) width = std::max(width, name.size());
  fmt::print(
      "\njoints: change of the angles between the segments that meet there\n  {:<{}} {:>12} {:>16} {:>16}  "
      "dynamic\n",
      "joint", width, "degrees", "degrees/frame", "strongest GOP");
  for (std::size_t j = 0; j < report.skeleton.joint_names.size(); ++j) {
    JointSummary joint;
    for (const GopStatistics& gop : report.gops) {
      joint.angle_sum += gop.joints[j].angle_sum;
      joint.strongest = std::max(joint.strongest, per_frame(gop.joints[j].angle_sum, gop.measured_frames));
      if (gop.joints[j].dynamic) ++joint.dynamic;
    }
    const std::string verdict = joint.dynamic == 0 ? "no"
                                : joint.dynamic == report.gops.size()
                                    ? "yes"
                                    : fmt::format("in {} of {} GOPs", joint.dynamic, report.gops.size());
    fmt::print("  {:<{}} {:>12.2f} {:>16.3f} {:>16.3f}  {}\n", report.skeleton.joint_names[j], width,
               joint.angle_sum, per_frame(joint.angle_sum, steps + 1), joint.strongest, verdict);
  }
  fmt::print("  dynamic: above {}\n",
             report.importance.skel.threshold
                 ? fmt::format("{:g} degrees per frame", *report.importance.skel.threshold)
                 : "a quarter of the strongest joint's sum, and above 0.1 degrees per frame");
}

std::uint64_t frame_count(const MeasureReport& report) {
  return report.gops.empty() ? 0 : report.gops.back().first_frame + report.gops.back().frame_count;
}

bool has_joints(const MeasureReport& report) {
  return !report.gops.empty() && !report.gops.front().joints.empty();
}

nlohmann::json json_of(const Importance& importance, const std::string& criteria) {
  nlohmann::json json = {{"criteria", criteria},
                         {"alpha", importance.curv.alpha},
                         {"smoothing", importance.smoothing},
                         {"low_delay", importance.low_delay}};
  if (importance.threshold) {
    json["threshold"] = *importance.threshold;
  } else {
    json["share"] = importance.share;
  }
  return json;
}

nlohmann::json json_of(const GopStatistics& gop, const MeasureReport& report) {
  nlohmann::json json = {{"first_frame", report.first_frame + gop.first_frame},
                         {"frame_count", gop.frame_count},
                         {"measured_frames", gop.measured_frames},
                         {"important", gop.important},
                         {"share", share_of(gop.important, report.vertices)},
                         {"changed", gop.changed}};
  json["cost"] = {
      {"smallest", gop.smallest},
      {"median", gop.median},
      {"mean", gop.mean},
      {"largest", gop.largest},
      {"lowest_important", nullptr},
      {"histogram",
       {{"low", gop.histogram.low}, {"high", gop.histogram.high}, {"counts", gop.histogram.counts}}}};
  if (gop.lowest_important) json["cost"]["lowest_important"] = *gop.lowest_important;
  for (std::size_t j = 0; j < gop.joints.size(); ++j) {
    json["joints"].push_back({{"name", report.skeleton.joint_names[j]},
                              {"angle_sum", gop.joints[j].angle_sum},
                              {"degrees_per_frame", per_frame(gop.joints[j].angle_sum, gop.measured_frames)},
                              {"dynamic", gop.joints[j].dynamic}});
  }
  return json;
}

}  // namespace

void print_report(const MeasureReport& report) {
  fmt::print("{}: {} vertices, {} faces, {} frames in {} {}\n", report.input, report.vertices, report.faces,
             frame_count(report), report.gops.size(), report.gops.size() == 1 ? "GOP" : "GOPs");
  fmt::print("  measured by {}, {}\n", report.criteria, marking(report.importance));
  print_gops(report);
  if (has_joints(report)) print_joints(report);
}

void print_report_json(const MeasureReport& report) {
  nlohmann::json json;
  json["input"] = report.input;
  json["measure"] = json_of(report.importance, report.criteria);
  json["vertices"] = report.vertices;
  json["faces"] = report.faces;
  json["frames"] = frame_count(report);
  for (const GopStatistics& gop : report.gops) json["gops"].push_back(json_of(gop, report));
  if (has_joints(report)) {
    for (std::size_t j = 0; j < report.skeleton.joint_names.size(); ++j) {
      const std::int32_t parent = report.skeleton.parents[j];
      json["skeleton"].push_back({{"name", report.skeleton.joint_names[j]},
                                  {"parent", parent < 0 ? nlohmann::json() : nlohmann::json(parent)}});
    }
  }
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace tvg::cli
