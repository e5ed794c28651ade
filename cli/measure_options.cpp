#include "cli/measure_options.hpp"

#include "cli/number_option.hpp"
#include "encoder/importers/vertex_weights.hpp"
#include "tool/option_values.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace tvg::cli {

namespace {

[[noreturn]] void fail_usage(const std::string& message) {
  throw ToolError(ExitStatus::kUsage, message);
}

std::string criterion_names() {
  std::vector<std::string_view> names;
  for (const CriterionDescription& criterion : criterion_descriptions()) names.push_back(criterion.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

[[noreturn]] void fail_criteria(const std::string& text) {
  fail_usage(
      fmt::format("--measure {}: write criteria with their weights as curv or curv+0.5*skel-velocity; there "
                  "are {}",
                  text, criterion_names()));
}

/// The longest name of a criterion that `text` begins with: curvature-norm goes before curv, and
/// curv-velocity is two of them.
std::string_view leading_name(std::string_view text) {
  std::string_view longest;
  for (const CriterionDescription& criterion : criterion_descriptions()) {
    if (text.starts_with(criterion.name) && criterion.name.size() > longest.size()) longest = criterion.name;
  }
  return longest;
}

bool has_criterion(const Importance& importance, std::string_view name) {
  return std::any_of(importance.criteria.begin(), importance.criteria.end(),
                     [name](const CriterionWeight& term) { return term.name == name; });
}

std::array<double, 3> parse_viewpoint(const std::string& text) {
  std::array<double, 3> place{};
  const char* at = text.data();
  const char* end = text.data() + text.size();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [after, error] = std::from_chars(at, end, place[k]);
    const bool separated = k < 2 ? after != end && *after == ',' : after == end;
    if (error != std::errc() || !separated || !std::isfinite(place[k])) {
      fail_usage(fmt::format("--viewpoint {}: write a place in the mesh's units as 0,1.5,-4", text));
    }
    at = after + 1;
  }
  return place;
}

/// An option that only matters to some criteria, and whether it was given.
struct Dependent {
  const char* option;
  bool given;
  std::vector<std::string_view> criteria;
};

void check_dependents(const CostArguments& arguments, const Importance& importance) {
  const std::array<Dependent, 6> dependents = {{
      {"--alpha", arguments.alpha.has_value(), {"curv", "curvature-norm"}},
      {"--skel-alpha", arguments.skel_alpha.has_value(), {"skel"}},
      {"--skel-threshold", arguments.skel_threshold.has_value(), {"skel"}},
      {"--skel-region", !arguments.skel_region.empty(), {"skel"}},
      {"--viewpoint", !arguments.viewpoint.empty(), {"distance"}},
      {"--weights", !arguments.weights.empty(), {"weights"}},
  }};
  for (const Dependent& dependent : dependents) {
    const bool used = std::any_of(dependent.criteria.begin(), dependent.criteria.end(),
                                  [&](std::string_view name) { return has_criterion(importance, name); });
    if (!dependent.given || used) continue;
    fail_usage(fmt::format("{} is for the criterion {}, which --measure {} does not use", dependent.option,
                           fmt::join(dependent.criteria, " or "), arguments.criteria));
  }
}

std::function<void(double)> into(std::optional<double>& place) {
  return [&place](double value) { place = value; };
}

}  // namespace

bool CostArguments::any() const {
  return criteria != "curv" || alpha || skel_alpha || skel_threshold || !skel_region.empty() ||
         !viewpoint.empty() || !weights.empty() || smoothing;
}

bool MeasureArguments::any() const {
  return CostArguments::any() || !important.empty() || threshold || !lookahead.empty();
}

std::vector<CriterionWeight> parse_criteria(const std::string& text) {
  std::vector<CriterionWeight> criteria;
  std::string_view rest = text;
  while (!rest.empty() || criteria.empty()) {
    const bool has_sign = rest.starts_with('+') || rest.starts_with('-');
    if (!has_sign && !criteria.empty()) fail_criteria(text);
    double weight = rest.starts_with('-') ? -1 : 1;
    if (has_sign) rest.remove_prefix(1);
    double factor = 1;
    const auto [after, error] = std::from_chars(rest.data(), rest.data() + rest.size(), factor);
    if (error == std::errc() && factor >= 0 && std::isfinite(factor)) {
      rest.remove_prefix(static_cast<std::size_t>(after - rest.data()));
      if (!rest.starts_with('*')) fail_criteria(text);
      rest.remove_prefix(1);
      weight *= factor;
    }
    const std::string_view name = leading_name(rest);
    if (name.empty()) fail_criteria(text);
    rest.remove_prefix(name.size());
    criteria.push_back({std::string(name), weight});
  }
  return criteria;
}

void add_cost_options(CLI::App& command, CostArguments& arguments) {
  command
      .add_option("--measure", arguments.criteria,
                  fmt::format("what makes vertices important: criteria with weights, as curv+0.5*skel, or as "
                              "=-distance where the first is negative; {}",
                              criterion_names()))
      ->capture_default_str();
  add_number(command, "--alpha", {0, 1}, into(arguments.alpha),
             fmt::format("of curv: weight of the change of curvature against its mean (default {})",
                         Importance().alpha));
  add_number(command, "--skel-alpha", {0, 1}, into(arguments.skel_alpha),
             fmt::format("of skel: value at joints that bend; elsewhere it is 1 minus this (default {})",
                         Importance().skel_alpha));
  add_number(command, "--skel-threshold", {0}, into(arguments.skel_threshold),
             "of skel: degrees per frame above which a joint bends (default: a quarter of the strongest "
             "joint's, at least 0.1)");
  command
      .add_option(
          "--skel-region", arguments.skel_region,
          "of skel: the joint of a vertex is the nearest (default) or that of its largest skin weight "
          "(weights)")
      ->check(CLI::IsMember({"nearest", "weights"}));
  command.add_option("--viewpoint", arguments.viewpoint,
                     "of distance: where it is measured from, as 0,1.5,-4");
  command.add_option("--weights", arguments.weights,
                     "of weights: a number per vertex, one on each line, or a .npy");
  command
      .add_option(
          "--smooth", arguments.smoothing,
          "times the cost is averaged over neighbours (default 0): marks in one piece cost fewer bytes")
      ->check(CLI::Range(0U, kMaxSmoothing));
}

void add_measure_options(CLI::App& command, MeasureArguments& arguments) {
  add_cost_options(command, arguments);
  auto* share = command.add_option("--important", arguments.important,
                                   "share of important vertices where there are two resolutions (default "
                                   "35%)");
  // Negative weights make negative costs, so a threshold may be any number.
  add_number(command, "--important-above", {}, into(arguments.threshold),
             "instead: vertices whose cost is above this")
      ->excludes(share);
  command
      .add_option(
          "--lookahead", arguments.lookahead,
          "frames that mark a GOP: its own (gop, the default), or those of the GOP before (0), so that "
          "nothing waits")
      ->check(CLI::IsMember({"gop", "0"}));
}

Importance importance_of(const CostArguments& arguments) {
  Importance importance;
  importance.criteria = parse_criteria(arguments.criteria);
  check_dependents(arguments, importance);
  importance.alpha = arguments.alpha.value_or(importance.alpha);
  importance.skel_alpha = arguments.skel_alpha.value_or(importance.skel_alpha);
  importance.skel_threshold = arguments.skel_threshold;
  if (arguments.skel_region == "weights") importance.skel_region = JointRegion::kHeaviest;
  importance.smoothing = arguments.smoothing.value_or(importance.smoothing);
  if (has_criterion(importance, "distance")) {
    if (arguments.viewpoint.empty()) {
      fail_usage("--measure distance: say from where with --viewpoint, as --viewpoint 0,1.5,-4");
    }
    importance.viewpoint = parse_viewpoint(arguments.viewpoint);
  }
  if (has_criterion(importance, "weights")) {
    if (arguments.weights.empty()) {
      fail_usage("--measure weights: name the file of the weights with --weights (text or .npy)");
    }
    importance.weights = read_vertex_weights(arguments.weights);
  }
  return importance;
}

Importance importance_of(const MeasureArguments& arguments) {
  Importance importance = importance_of(static_cast<const CostArguments&>(arguments));
  if (!arguments.important.empty()) importance.share = parse_share(arguments.important);
  importance.threshold = arguments.threshold;
  importance.low_delay = arguments.lookahead == "0";
  return importance;
}

std::string words_for(const CostArguments& arguments) {
  if (!arguments.any()) return arguments.criteria + ", the default";
  std::string words = arguments.criteria;
  const auto add = [&words](const char* name, const auto& value) {
    if (value) words += fmt::format(", {} {:g}", name, static_cast<double>(*value));
  };
  add("alpha", arguments.alpha);
  add("skel-alpha", arguments.skel_alpha);
  add("skel-threshold", arguments.skel_threshold);
  if (arguments.skel_region == "weights") words += ", by skin weights";
  if (!arguments.viewpoint.empty()) words += " from " + arguments.viewpoint;
  add("smooth", arguments.smoothing);
  return words;
}

void check_measure(const CostArguments& arguments, const Importance& importance, const FrameSource& source,
                   const std::vector<std::string>& inputs) {
  if (uses_skeleton(importance) && source.skeleton().empty()) {
    fail_usage(
        fmt::format("--measure {}: {} has no skeleton: a rigged scene (glTF, FBX, COLLADA and others) brings "
                    "one, and --skeleton names the file of one for other inputs",
                    arguments.criteria, fmt::join(inputs, ", ")));
  }
  if (importance.skel_region == JointRegion::kHeaviest && source.skeleton().heaviest_joint.empty()) {
    fail_usage(fmt::format("--skel-region weights: {} has no skin weights; use --skel-region nearest",
                           fmt::join(inputs, ", ")));
  }
  if (has_criterion(importance, "weights") && importance.weights.size() != source.mesh().vertex_count) {
    fail_usage(fmt::format("--weights {}: {} numbers for the mesh's {} vertices", arguments.weights,
                           importance.weights.size(), source.mesh().vertex_count));
  }
}

}  // namespace tvg::cli
