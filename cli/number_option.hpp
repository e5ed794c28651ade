#pragma once
#include "tool/option_values.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace tvg::cli {

/// Declares an option that takes a number, which parse_number() reads: `set` hears of none that is outside
/// `range`, nan or infinite.
CLI::Option* add_number(CLI::App& command, const std::string& option, const NumberRange& range,
                        const std::function<void(double)>& set, const std::string& help);

/// The same for what counts, which parse_count() reads: CLI11 takes -1 for the largest number.
CLI::Option* add_count(CLI::App& command, const std::string& option,
                       const std::function<void(std::uint64_t)>& set, const std::string& help);

}  // namespace tvg::cli
