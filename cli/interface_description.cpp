#include "cli/interface_description.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

namespace tvg::cli {

namespace {

std::string first_or_none(const std::vector<std::string>& names) {
  return names.empty() ? std::string{} : names.front();
}

/// What stands between braces: CLI11 writes a choice as "TEXT:{elp,basis}".
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}', begin);
  std::vector<std::string> choices;
  if (begin == std::string::npos || end == std::string::npos) return choices;
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string choice; std::getline(list, choice, ',');) choices.push_back(choice);
  return choices;
}

OptionDescription describe_option(const CLI::Option& option) {
  OptionDescription description;
  description.short_name = first_or_none(option.get_snames());
  description.long_name = first_or_none(option.get_lnames());
  description.text = option.get_description();
  if (option.get_items_expected_max() > 0) {
    const std::string type = option.get_type_name();
    description.value = type.substr(0, type.find_first_of(": "));
    description.choices = choices_in(type);
  }
  return description;
}

CommandDescription describe_command(const CLI::App& command) {
  CommandDescription description{command.get_name(), command.get_description(), {}, {}};
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      description.arguments.push_back({option->get_single_name(), option->get_description(),
                                       option->get_required(), option->get_items_expected_max() > 1});
    } else {
      description.options.push_back(describe_option(*option));
    }
  }
  return description;
}

}  // namespace

std::vector<CommandDescription> describe_commands(const CLI::App& tool) {
  std::vector<CommandDescription> commands;
  for (const CLI::App* command : tool.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(describe_command(*command));
  return commands;
}

}  // namespace tvg::cli
