#include "cli/interface_description.hpp"

#include <fmt/format.h>

namespace tvg::cli {

namespace {

/// As man(7) takes text: a hyphen that is typed is no dash, and no line begins with a macro.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\\') {
      result += "\\e";
    } else if (letter == '-') {
      result += "\\-";
    } else {
      result += letter;
    }
  }
  return !result.empty() && (result.front() == '.' || result.front() == '\'') ? "\\&" + result : result;
}

std::string head(const std::string& name, const std::string& version, const std::string& text) {
  std::string upper = name;
  for (char& letter : upper)
    letter = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  return fmt::format(".TH \"{}\" 1 \"\" \"tvg {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", upper, version,
                     escaped(name), escaped(text));
}

std::string argument_synopsis(const ArgumentDescription& argument) {
  const std::string name =
      fmt::format("\\fI{}\\fR{}", escaped(argument.name), argument.may_repeat ? "..." : "");
  return argument.is_required ? name : "[" + name + "]";
}

std::string option_entry(const OptionDescription& option) {
  std::string names;
  if (!option.short_name.empty()) names += fmt::format("\\fB\\-{}\\fR", escaped(option.short_name));
  if (!option.long_name.empty())
    names += fmt::format("{}\\fB\\-\\-{}\\fR", names.empty() ? "" : ", ", escaped(option.long_name));
  if (!option.value.empty()) names += fmt::format(" \\fI{}\\fR", escaped(option.value));
  std::string choices;
  for (const std::string& choice : option.choices)
    choices += fmt::format("{}\\fB{}\\fR", choices.empty() ? " (" : ", ", escaped(choice));
  if (!choices.empty()) choices += ")";
  return fmt::format(".TP\n{}\n{}{}\n", names, escaped(option.text), choices);
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n0 fine, 1 usage, 2 input or output, 3 invalid input file, 4 other failure.\n";

std::string page_of_tool(const std::vector<CommandDescription>& commands, const std::string& version) {
  std::string page = head("tvg", version, "compress, inspect and restore time-variant geometry");
  page += ".SH SYNOPSIS\n\\fBtvg\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
  for (const CommandDescription& command : commands) {
    page += fmt::format(".TP\n\\fB{}\\fR\n{}; see \\fBtvg\\-{}\\fR(1)\n", escaped(command.name),
                        escaped(command.text), escaped(command.name));
  }
  return page + kExitStatus;
}

std::string page_of_command(const CommandDescription& command, const std::string& version) {
  std::string page = head("tvg-" + command.name, version, command.text);
  page += fmt::format(".SH SYNOPSIS\n\\fBtvg {}\\fR [\\fIOPTIONS\\fR]", escaped(command.name));
  for (const ArgumentDescription& argument : command.arguments) page += " " + argument_synopsis(argument);
  page += "\n";
  if (!command.arguments.empty()) page += ".SH ARGUMENTS\n";
  for (const ArgumentDescription& argument : command.arguments)
    page += fmt::format(".TP\n\\fI{}\\fR\n{}\n", escaped(argument.name), escaped(argument.text));
  page += ".SH OPTIONS\n";
  for (const OptionDescription& option : command.options) page += option_entry(option);
  return page + kExitStatus + ".SH SEE ALSO\n\\fBtvg\\fR(1)\n";
}

}  // namespace

std::string manual_page(const std::vector<CommandDescription>& commands, const std::string& command,
                        const std::string& version) {
  for (const CommandDescription& description : commands) {
    if (description.name == command) return page_of_command(description, version);
  }
  return page_of_tool(commands, version);
}

}  // namespace tvg::cli
