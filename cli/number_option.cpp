#include "cli/number_option.hpp"

#include <CLI/CLI.hpp>

namespace tvg::cli {

CLI::Option* add_number(CLI::App& command, const std::string& option, const NumberRange& range,
                        const std::function<void(double)>& set, const std::string& help) {
  return command
      .add_option_function<std::string>(
          option, [option, range, set](const std::string& text) { set(parse_number(option, text, range)); },
          help)
      ->type_name("NUMBER");
}

CLI::Option* add_count(CLI::App& command, const std::string& option,
                       const std::function<void(std::uint64_t)>& set, const std::string& help) {
  return command
      .add_option_function<std::string>(
          option, [option, set](const std::string& text) { set(parse_count(option, text)); }, help)
      ->type_name("COUNT");
}

}  // namespace tvg::cli
