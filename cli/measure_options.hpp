#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <tvg/measure.hpp>
#include <tvg/source.hpp>

namespace CLI {
class App;
}

// What a user says about the measure, for every command that uses it.
namespace tvg::cli {

/// What the cost of a vertex is: values of the options as typed.
struct CostArguments {
  std::string option = "--measure";  ///< what names the criteria, for messages
  std::string criteria = "curv";
  std::map<std::string, std::string> options;  ///< of criterion_options(), by their names: those given
  std::optional<std::uint32_t> smoothing;

  /// Whether any option was given.
  bool any() const;
  /// The file of --weights; empty where none was given.
  std::string weights() const;
};

/// The cost, and which vertices it marks.
struct MeasureArguments : CostArguments {
  std::string important;
  std::optional<double> threshold;
  std::string lookahead;

  /// Whether any option was given.
  bool any() const;
};

/// Declares --measure, the options of its criteria and --smooth; `arguments` must outlive the parsing.
void add_cost_options(CLI::App& command, CostArguments& arguments);
/// The same without --measure, for a command that asks for the criteria in its own words.
void add_criterion_options(CLI::App& command, CostArguments& arguments);
/// These, and --important and the like.
void add_measure_options(CLI::App& command, MeasureArguments& arguments);

/// "curv+0.5*skel-velocity": criteria and their weights. Throws ToolError (kUsage) that names the criteria
/// and the option they stand in.
std::vector<CriterionWeight> parse_criteria(const std::string& text, const std::string& option = "--measure");

/// "curv, skel, ...": every criterion there is.
std::string criterion_names();

/// What the options mean together; reads the file of --weights. Throws ToolError: kUsage for options that are
/// wrong or do not belong to the criteria chosen, and as read_vertex_weights() does.
Importance importance_of(const CostArguments& arguments);
Importance importance_of(const MeasureArguments& arguments);

/// The cost in a few words: "curv, the default", "curv+0.5*skel, smooth 2".
std::string words_for(const CostArguments& arguments);

/// Throws ToolError (kUsage) that names the option at fault unless the criteria find what they need in the
/// source that `inputs` name.
void check_measure(const CostArguments& arguments, const Importance& importance, const FrameSource& source,
                   const std::vector<std::string>& inputs);

}  // namespace tvg::cli
