#include "cli/commands.hpp"

#include <CLI/CLI.hpp>
namespace tvg::cli {
void add_join_command(CLI::App&) {}
}  // namespace tvg::cli
