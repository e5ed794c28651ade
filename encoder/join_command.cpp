#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
namespace tvg::cli {
void add_join_command(CLI::App&) {}
}  // namespace tvg::cli
