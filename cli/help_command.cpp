#include "cli/commands.hpp"
#include "cli/interface_description.hpp"
#include "cli/usage_error.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace tvg::cli {

namespace {

struct HelpArguments {
  std::string command;
  std::string completion;
  bool manual = false;
};

void check_is_command(const std::vector<CommandDescription>& commands, const std::string& name) {
  std::vector<std::string> names;
  for (const CommandDescription& command : commands) names.push_back(command.name);
  for (const std::string& known : names) {
    if (known == name) return;
  }
  const std::string meant = likely_meant(name, names);
  throw ToolError(ExitStatus::kUsage, fmt::format("{} is no command{}", name,
                                                  meant.empty() ? "; tvg help lists all"
                                                                : fmt::format(": did you mean {}?", meant)));
}

void run_help(const CLI::App& tool, const HelpArguments& arguments) {
  const std::vector<CommandDescription> commands = describe_commands(tool);
  const std::string& name = arguments.command;
  if (!name.empty()) check_is_command(commands, name);
  if (!arguments.completion.empty()) {
    fmt::print("{}", completion_script(commands, arguments.completion));
  } else if (arguments.manual) {
    fmt::print("{}", manual_page(commands, name, TVG_VERSION));
  } else if (name.empty()) {
    // What tool.help() gives is that of the command being run, which is this one.
    fmt::print("{}", tool.get_formatter()->make_help(&tool, tool.get_name(), CLI::AppFormatMode::Normal));
  } else {
    fmt::print("{}", tool.get_subcommand(name)->help(tool.get_name()));
  }
}

}  // namespace

void add_help_command(CLI::App& tool) {
  auto arguments = std::make_shared<HelpArguments>();
  CLI::App& command = *tool.add_subcommand("help", "Show what a command does, and its options");
  command.add_option("command", arguments->command, "the command; all of them where none is named");
  command.add_flag("--man", arguments->manual, "print it as a manual page");
  command
      .add_option("--completion", arguments->completion,
                  "print the script by which a shell completes commands and options")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command.callback([&tool, arguments] { run_help(tool, *arguments); });
}

}  // namespace tvg::cli
