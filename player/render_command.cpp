#include "cli/commands.hpp"

namespace tvg::cli {

void add_render_command(CLI::App&) {}

}  // namespace tvg::cli
