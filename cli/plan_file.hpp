#pragma once
#include "cli/encode_options.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <tvg/parts.hpp>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace tvg::cli {

/// What `tvg plan` writes and `tvg encode --plan` and `tvg join --plan` read: how an animation is encoded,
/// what all of it was seen to be, and who encodes which frames. Names of files in it are relative to its
/// folder, unless they are absolute.
struct PlanFile {
  struct Part {
    FrameRange frames;
    std::string file;
  };

  /// The options of the encoding and the inputs ("input"), as typed: values by their names.
  std::map<std::string, std::vector<std::string>> options;
  EncodePlan plan;
  std::shared_ptr<const MeshLevels> levels;  ///< of --levels and --lod; may be null
  std::vector<Part> parts;
  std::string output;  ///< the stream of all parts
  std::string folder;  ///< of the file, with a slash at its end; empty where it is the present one

  /// A name in it as it is to be opened from here.
  std::string path_of(const std::string& file) const;
  /// What parts are known by: a hash of all that makes a difference to them.
  std::string id() const;
  /// "part 3 of 16 (frames 100-149)"; `number` from 1 on.
  std::string name_of_part(std::size_t number) const;
};

/// What a plan calls an option: "--bits"; what is given without a name, "input".
std::string option_name(const CLI::Option& option);

/// Where the file of a plan may name others: what was typed of a command's options, with names of files as
/// they are from the folder of `plan_path`.
std::map<std::string, std::vector<std::string>> typed_options(const CLI::App& command,
                                                              const std::string& plan_path);

/// The options of a plan, as `tvg encode` would have them. Throws ToolError (kInvalidInput) where they are
/// none.
EncodeArguments arguments_of(const PlanFile& plan);

/// Names the parts and the stream of all of them after the plan's file: "hand.part-03-of-16.tvg" and
/// "hand.tvg" of "hand.plan.json".
void name_outputs(PlanFile& plan, const std::string& plan_path, const std::vector<FrameRange>& parts);

/// Writes a plan. Throws ToolError (kIo).
void write_plan(const PlanFile& plan, const std::string& path);
/// Throws ToolError: kIo where it cannot be read, kInvalidInput where it is no plan.
PlanFile read_plan(const std::string& path);

}  // namespace tvg::cli
