#include "cli/measure_options.hpp"

#include "cli/criterion_options.hpp"
#include "cli/number_option.hpp"
#include "tool/option_values.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

[[noreturn]] void fail_usage(const std::string& message) {
  throw ToolError(ExitStatus::kUsage, message);
}

[[noreturn]] void fail_criteria(const std::string& option, const std::string& text) {
  fail_usage(
      fmt::format("{} {}: write criteria with their weights as curv or curv+0.5*skel-velocity; there "
                  "are {}",
                  option, text, criterion_names()));
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

bool is_for(const CriterionOption& option, const Importance& importance) {
  return std::any_of(option.criteria.begin(), option.criteria.end(),
                     [&](std::string_view name) { return has_criterion(importance, name); });
}

void set_option(const CriterionOption& option, const CostArguments& arguments, Importance& importance) {
  const auto given = arguments.options.find(option.name);
  const bool used = is_for(option, importance);
  if (given != arguments.options.end()) {
    if (used) return option.set(given->second, importance);
    fail_usage(fmt::format("{} is for the criterion {}, which {} {} does not use", option.name,
                           fmt::join(option.criteria, " or "), arguments.option, arguments.criteria));
  }
  if (!used || option.missing == nullptr) return;
  fail_usage(fmt::format("{} {}: {}", arguments.option, arguments.criteria, option.missing));
}

}  // namespace

std::string criterion_names() {
  std::vector<std::string_view> names;
  for (const CriterionDescription& criterion : criterion_descriptions()) names.push_back(criterion.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

bool CostArguments::any() const {
  return criteria != "curv" || !options.empty() || smoothing;
}

std::string CostArguments::weights() const {
  const auto given = options.find("--weights");
  return given != options.end() ? given->second : "";
}

bool MeasureArguments::any() const {
  return CostArguments::any() || !important.empty() || threshold || !lookahead.empty();
}

std::vector<CriterionWeight> parse_criteria(const std::string& text, const std::string& option) {
  std::vector<CriterionWeight> criteria;
  std::string_view rest = text;
  while (!rest.empty() || criteria.empty()) {
    const bool has_sign = rest.starts_with('+') || rest.starts_with('-');
    if (!has_sign && !criteria.empty()) fail_criteria(option, text);
    double weight = rest.starts_with('-') ? -1 : 1;
    if (has_sign) rest.remove_prefix(1);
    double factor = 1;
    const auto [after, error] = std::from_chars(rest.data(), rest.data() + rest.size(), factor);
    if (error == std::errc() && factor >= 0 && std::isfinite(factor)) {
      rest.remove_prefix(static_cast<std::size_t>(after - rest.data()));
      if (!rest.starts_with('*')) fail_criteria(option, text);
      rest.remove_prefix(1);
      weight *= factor;
    }
    const std::string_view name = leading_name(rest);
    if (name.empty()) fail_criteria(option, text);
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
  add_criterion_options(command, arguments);
}

void add_criterion_options(CLI::App& command, CostArguments& arguments) {
  for (const CriterionOption& option : criterion_options()) {
    const auto keep = [&arguments, name = option.name](const std::string& text) {
      arguments.options[name] = text;
    };
    command.add_option_function<std::string>(option.name, keep, option.help)->type_name(option.type);
  }
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
  add_number(
      command, "--important-above", {}, [&arguments](double value) { arguments.threshold = value; },
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
  importance.criteria = parse_criteria(arguments.criteria, arguments.option);
  importance.smoothing = arguments.smoothing.value_or(importance.smoothing);
  for (const CriterionOption& option : criterion_options()) set_option(option, arguments, importance);
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
  for (const CriterionOption& option : criterion_options()) {
    const auto given = arguments.options.find(option.name);
    if (given == arguments.options.end()) continue;
    words +=
        fmt::format(", {} {}", option.name + 2, std::filesystem::path(given->second).filename().string());
  }
  if (arguments.smoothing) words += fmt::format(", smooth {}", *arguments.smoothing);
  return words;
}

void check_measure(const CostArguments& arguments, const Importance& importance, const FrameSource& source,
                   const std::vector<std::string>& inputs) {
  if (uses_skeleton(importance) && source.skeleton().empty()) {
    fail_usage(
        fmt::format("{} {}: {} has no skeleton: a rigged scene (glTF, FBX, COLLADA and others) brings "
                    "one, and --skeleton names the file of one for other inputs",
                    arguments.option, arguments.criteria, fmt::join(inputs, ", ")));
  }
  if (importance.skel.region == JointRegion::kHeaviest && source.skeleton().heaviest_joint.empty()) {
    fail_usage(fmt::format("--skel-region weights: {} has no skin weights; use --skel-region nearest",
                           fmt::join(inputs, ", ")));
  }
  if (has_criterion(importance, "weights") && importance.weights.size() != source.mesh().vertex_count) {
    fail_usage(fmt::format("--weights {}: {} numbers for the mesh's {} vertices", arguments.weights(),
                           importance.weights.size(), source.mesh().vertex_count));
  }
}

}  // namespace tvg::cli
