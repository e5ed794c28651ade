#pragma once
#include "player/view/look.hpp"

namespace CLI {
class App;
}

namespace tvg::cli {

/// Declares --size, --camera, --shading and the like; `arguments` must outlive the parsing.
void add_view_options(CLI::App& command, LookArguments& arguments);
/// These, and --overlay and --ref.
void add_look_options(CLI::App& command, LookArguments& arguments);

}  // namespace tvg::cli
