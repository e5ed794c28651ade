#pragma once
#include "cli/encode_options.hpp"
#include "tool/atomic_folder.hpp"

#include <string>

namespace CLI {
class App;
}

namespace tvg::cli {

/// The name of the file that says which streams there are of one animation (docs/formats.md).
inline constexpr const char* kLadderFile = "ladder.json";

struct LadderArguments : EncodeArguments {
  unsigned steps = 3;
};

/// The defaults that a stream for the web has: mode basis.
void set_web_defaults(EncodeArguments& arguments);

/// Declares --steps.
void add_ladder_options(CLI::App& command, LadderArguments& arguments);

/// Throws ToolError (kUsage) for options that a ladder cannot have, before anything is opened.
void check_ladder_options(const LadderArguments& arguments);

/// Encodes the steps of a ladder into a folder, which the caller finishes, ladder.json after its streams;
/// prints what became of them unless it is to be quiet. Gives the path at which the best stream lies until
/// then. Throws ToolError as encoding does, kUsage where the input can be read only once.
std::string write_ladder(const LadderArguments& arguments, AtomicFolder& folder);

}  // namespace tvg::cli
