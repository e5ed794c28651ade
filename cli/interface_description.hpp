#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tvg::cli {

/// One option of a command, as manual pages and completions need it.
struct OptionDescription {
  std::string short_name;            ///< "q"; "" where there is none
  std::string long_name;             ///< "quiet"
  std::string value;                 ///< what kind of value it takes, "TEXT"; "" for a flag
  std::vector<std::string> choices;  ///< the values that it takes, where they are few
  std::string text;                  ///< one sentence
};

/// What a command takes without a name.
struct ArgumentDescription {
  std::string name;
  std::string text;
  bool is_required = false;
  bool may_repeat = false;
};

struct CommandDescription {
  std::string name;
  std::string text;
  std::vector<ArgumentDescription> arguments;
  std::vector<OptionDescription> options;
};

/// Every command of the tool, in its order, as `--help` shows it.
std::vector<CommandDescription> describe_commands(const CLI::App& tool);

/// The manual page of a command, or with "" the tool's, in man(7)'s macros. `version` stands at its foot.
std::string manual_page(const std::vector<CommandDescription>& commands, const std::string& command,
                        const std::string& version);

/// A script that completes commands, options and their values in a shell: "bash", "zsh" or "fish".
std::string completion_script(const std::vector<CommandDescription>& commands, const std::string& shell);

}  // namespace tvg::cli
