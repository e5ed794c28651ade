#include "cli/interface_description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tvg::cli {

namespace {

/// Between single quotes of a shell, where fish and POSIX shells differ in nothing but what stands for a
/// quote.
std::string quoted(const std::string& text, const char* quote) {
  std::string result = "'";
  for (const char letter : text) result += letter == '\'' ? std::string(quote) : std::string(1, letter);
  return result + "'";
}

/// "-q --quiet --json": each name of each option.
std::string option_names(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options) {
    if (!option.short_name.empty()) names.push_back("-" + option.short_name);
    if (!option.long_name.empty()) names.push_back("--" + option.long_name);
  }
  return fmt::format("{}", fmt::join(names, " "));
}

std::string command_names(const std::vector<CommandDescription>& commands) {
  std::string names;
  for (const CommandDescription& command : commands) names += (names.empty() ? "" : " ") + command.name;
  return names;
}

std::string bash_script(const std::vector<CommandDescription>& commands) {
  std::string values;
  std::string options;
  for (const CommandDescription& command : commands) {
    options += fmt::format("    {}) options='{}' ;;\n", command.name, option_names(command));
    for (const OptionDescription& option : command.options) {
      if (option.choices.empty()) continue;
      values += fmt::format("    '{} --{}') COMPREPLY=($(compgen -W '{}' -- \"$word\")); return ;;\n",
                            command.name, option.long_name, fmt::join(option.choices, " "));
    }
  }
  return fmt::format(R"(# bash completion for tvg
_tvg() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}} options=
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{} --help --version' -- "$word"))
    return
  fi
  case "$command $before" in
{}  esac
  case $command in
{}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  elif [ "$command" = help ]; then
    COMPREPLY=($(compgen -W '{}' -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _tvg tvg
)",
                     command_names(commands), values, options, command_names(commands));
}

/// zsh gives a bracket in an option's text a meaning, and a colon too.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') result += '\\';
    result += letter;
  }
  return result;
}

std::string zsh_option(const OptionDescription& option) {
  std::string entries;
  for (const std::string& name : {option.short_name.empty() ? "" : "-" + option.short_name,
                                  option.long_name.empty() ? "" : "--" + option.long_name}) {
    if (name.empty()) continue;
    std::string entry = fmt::format("{}[{}]", name, zsh_text(option.text));
    if (!option.choices.empty()) {
      entry += fmt::format(":{}:({})", option.value, fmt::join(option.choices, " "));
    } else if (!option.value.empty()) {
      entry += fmt::format(":{}:_files", option.value);
    }
    entries += fmt::format("        {} \\\n", quoted(entry, R"('\'')"));
  }
  return entries;
}

std::string zsh_script(const std::vector<CommandDescription>& commands) {
  std::string names;
  std::string cases;
  for (const CommandDescription& command : commands) {
    names += fmt::format("    {}\n", quoted(command.name + ":" + zsh_text(command.text), R"('\'')"));
    cases += fmt::format("    {})\n      _arguments -S \\\n", command.name);
    for (const OptionDescription& option : command.options) cases += zsh_option(option);
    const char* const words =
        command.name == "help" ? "'*::command:_describe command commands'" : "'*:file:_files'";
    cases += fmt::format("        {} ;;\n", words);
  }
  return fmt::format(R"(#compdef tvg
_tvg() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
_tvg "$@"
)",
                     names, cases);
}

std::string fish_script(const std::vector<CommandDescription>& commands) {
  std::string script = "# fish completion for tvg\ncomplete -c tvg -n __fish_use_subcommand -f\n";
  for (const CommandDescription& command : commands) {
    script += fmt::format("complete -c tvg -n __fish_use_subcommand -a {} -d {}\n", command.name,
                          quoted(command.text, R"(\')"));
  }
  for (const CommandDescription& command : commands) {
    for (const OptionDescription& option : command.options) {
      script += fmt::format("complete -c tvg -n '__fish_seen_subcommand_from {}'", command.name);
      if (!option.short_name.empty()) script += " -s " + option.short_name;
      if (!option.long_name.empty()) script += " -l " + option.long_name;
      if (!option.choices.empty()) {
        script += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
      } else if (!option.value.empty()) {
        script += " -r";
      }
      script += fmt::format(" -d {}\n", quoted(option.text, R"(\')"));
    }
  }
  return script + fmt::format("complete -c tvg -n '__fish_seen_subcommand_from help' -f -a '{}'\n",
                              command_names(commands));
}

}  // namespace

std::string completion_script(const std::vector<CommandDescription>& commands, const std::string& shell) {
  if (shell == "bash") return bash_script(commands);
  return shell == "zsh" ? zsh_script(commands) : fish_script(commands);
}

}  // namespace tvg::cli
