#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace tvg::cli {

/// The word of `known` that `word` is most likely meant to be; "" where none is near enough.
std::string likely_meant(const std::string& word, const std::vector<std::string>& known);

/// One line that says what is wrong with how the tool was called, and what would be right.
std::string usage_message(const CLI::App& tool, const CLI::ParseError& error);

}  // namespace tvg::cli
