#include "cli/commands.hpp"

namespace tvg::cli {

void add_play_command(CLI::App&) {}

}  // namespace tvg::cli
