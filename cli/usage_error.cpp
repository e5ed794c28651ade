#include "cli/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace tvg::cli {

namespace {

/// Letters to put in, leave out, change or swap with their neighbour that lead from one word to the other.
std::size_t edits_between(const std::string& from, const std::string& to) {
  std::vector<std::vector<std::size_t>> edits(from.size() + 1, std::vector<std::size_t>(to.size() + 1));
  for (std::size_t i = 0; i <= from.size(); ++i) {
    for (std::size_t j = 0; j <= to.size(); ++j) {
      if (i == 0 || j == 0) {
        edits[i][j] = i + j;
        continue;
      }
      const std::size_t changed = edits[i - 1][j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, changed});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[from.size()][to.size()];
}

std::vector<std::string> command_names(const CLI::App& tool) {
  std::vector<std::string> names;
  for (const CLI::App* command : tool.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// What follows a word that is not known.
std::string suggestion(const std::string& word, const std::vector<std::string>& known,
                       const std::string& otherwise) {
  const std::string meant = likely_meant(word, known);
  return meant.empty() ? otherwise : fmt::format("did you mean {}?", meant);
}

/// `command` may be the tool itself.
std::string unknown_option(const CLI::App& command, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  const std::string option = word.substr(0, word.find('='));
  const bool is_of_command = command.get_parent() != nullptr;
  const std::string name = is_of_command ? " " + command.get_name() : "";
  return fmt::format("tvg{}: there is no option {}; {}", name, option,
                     suggestion(option, known, fmt::format("tvg help{} lists all", name)));
}

}  // namespace

std::string likely_meant(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t fewest = 1 + std::max<std::size_t>(1, word.size() / 3);
  for (const std::string& other : known) {
    // Who breaks off in the middle of a word means that word.
    const bool is_begun = word.size() > 2 && other.rfind(word, 0) == 0;
    const std::size_t edits = is_begun ? 1 : edits_between(word, other);
    if (edits >= fewest) continue;
    fewest = edits;
    best = other;
  }
  return best;
}

std::string usage_message(const CLI::App& tool, const CLI::ParseError& error) {
  const std::vector<CLI::App*> named = tool.get_subcommands();
  const std::vector<std::string> names = command_names(tool);
  if (named.empty()) {
    const std::vector<std::string> unknown = tool.remaining();
    const std::string choice = fmt::format("name one of {}", fmt::join(names, " "));
    if (unknown.empty()) return "tvg: " + choice;
    if (unknown.front().front() == '-') return unknown_option(tool, unknown.front());
    return fmt::format("tvg: {} is no command: {}", unknown.front(),
                       suggestion(unknown.front(), names, choice));
  }
  const CLI::App& command = *named.back();
  for (const std::string& word : command.remaining()) {
    if (word.size() > 1 && word.front() == '-') return unknown_option(command, word);
  }
  return fmt::format("tvg {0}: {1}; tvg help {0} shows how it is used", command.get_name(), error.what());
}

}  // namespace tvg::cli
