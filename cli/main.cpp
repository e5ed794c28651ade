#include "cli/commands.hpp"
#include "cli/usage_error.hpp"
#include "tool/atomic_file.hpp"
#ifdef TVG_HAS_PLAYER
#include "player/playback/remote_input.hpp"
#endif
#include "tool/overwriting.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <system_error>

int main(int argc, char** argv) {
  using namespace tvg::cli;
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is an I/O error like another
  remove_temporary_files_on_signals();

  CLI::App tool("Compresses, inspects and restores time-variant geometry (.tvg).", "tvg");
  tool.set_version_flag("-v,--version", TVG_VERSION);
  tool.require_subcommand(1);
  tool.footer("Exit status: 0 fine, 1 usage, 2 I/O, 3 invalid input file, 4 other failure.");
  add_encode_command(tool);
  add_decode_command(tool);
  add_info_command(tool);
  add_verify_command(tool);
  add_compare_command(tool);
  add_measure_command(tool);
  add_simplify_command(tool);
  add_plan_command(tool);
  add_join_command(tool);
  add_ladder_command(tool);
  add_page_command(tool);
  add_bench_command(tool);
#ifdef TVG_HAS_PLAYER
  use_remote_opener(tvg::player::open_remote_input);
  add_play_command(tool);
  add_render_command(tool);
  add_serve_command(tool);
#endif
  add_help_command(tool);
  for (CLI::App* command : tool.get_subcommands([](CLI::App*) { return true; })) {
    if (command->get_option_no_throw("--output") == nullptr &&
        command->get_option_no_throw("--csv") == nullptr)
      continue;
    command->add_flag_callback("-f,--force", tvg::cli::overwrite_without_asking,
                               "replace files without asking; only a terminal is asked");
  }

  try {
    tool.parse(argc, argv);
    if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category());
    return static_cast<int>(ExitStatus::kSuccess);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // help or the version was asked for
      tool.exit(error);
      return static_cast<int>(ExitStatus::kSuccess);
    }
    std::cerr << usage_message(tool, error) << '\n';
    return static_cast<int>(ExitStatus::kUsage);
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
