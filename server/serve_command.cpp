#include "cli/commands.hpp"

namespace tvg::cli {

void add_serve_command(CLI::App&) {}

}  // namespace tvg::cli
