#include "cli/commands.hpp"
#include "tool/atomic_file.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

namespace {

/// What to say where no command is named, or one that does not exist.
std::string command_wanted(CLI::App& tool) {
  std::string message = "tvg: ";
  const std::vector<std::string> unknown = tool.remaining();
  if (!unknown.empty()) message += unknown.front() + " is no command: ";
  message += "name one of";
  for (const CLI::App* command : tool.get_subcommands([](CLI::App*) { return true; })) {
    message += " " + command->get_name();
  }
  return message;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace tvg::cli;
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is an I/O error like another
  remove_temporary_files_on_signals();

  CLI::App tool("Compresses, inspects and restores time-variant geometry (.tvg).", "tvg");
  tool.set_version_flag("--version", TVG_VERSION);
  tool.require_subcommand(1);
  tool.footer("Exit status: 0 fine, 1 usage, 2 I/O, 3 invalid input file, 4 other failure.");
  add_encode_command(tool);
  add_decode_command(tool);
  add_info_command(tool);
  add_verify_command(tool);
  add_compare_command(tool);
  add_measure_command(tool);
  add_simplify_command(tool);
  add_join_command(tool);
  add_ladder_command(tool);
  add_page_command(tool);
#ifdef TVG_HAS_PLAYER
  add_play_command(tool);
  add_render_command(tool);
  add_serve_command(tool);
#endif

  try {
    tool.parse(argc, argv);
    if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category());
    return static_cast<int>(ExitStatus::kSuccess);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError) &&
        tool.get_subcommands().empty()) {
      std::cerr << command_wanted(tool) << '\n';
      return static_cast<int>(ExitStatus::kUsage);
    }
    const bool asked_for_help = tool.exit(error) == 0;
    return static_cast<int>(asked_for_help ? ExitStatus::kSuccess : ExitStatus::kUsage);
  } catch (const ToolError& error) {
    std::cerr << "tvg: " << error.what() << '\n';
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) {  // what a command prints did not reach anyone
      std::cerr << "tvg: cannot write standard output: " << std::generic_category().message(errno) << '\n';
      return static_cast<int>(ExitStatus::kIo);
    }
    std::cerr << "tvg: " << error.what() << '\n';
    return static_cast<int>(ExitStatus::kOther);
  }
}
