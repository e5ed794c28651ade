#include "cli/commands.hpp"
#include "cli/page_job.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace tvg::cli {

namespace {

/// The options of encoding among those that were given, by their names.
std::vector<std::string> given_of(const std::vector<CLI::Option*>& encoding) {
  std::vector<std::string> names;
  for (const CLI::Option* option : encoding) {
    const bool is_other =
        option->get_positional() || option->check_lname("quiet") || option->check_lname("help");
    if (!is_other && option->count() > 0) names.push_back(option->get_name());
  }
  return names;
}

}  // namespace

void add_page_command(CLI::App& tool) {
  auto arguments = std::make_shared<PageArguments>();
  set_web_defaults(*arguments);
  CLI::App& command = *tool.add_subcommand("page", "Make a web page that plays an animation");
  add_encode_options(command, *arguments,
                     ", or a .tvg, or the folder of a ladder, which are taken as they are");
  const std::vector<CLI::Option*> encoding = command.get_options();
  command
      .add_option(
          "-o,--output", arguments->output,
          "folder of the page, made where it is missing; or one file with all in it (clip.html), which "
          "browsers also play from disk")
      ->required();
  command.add_option("--title", arguments->title, "what the page is called (default: after the input)");
  command.add_flag("--no-poster", arguments->no_poster,
                   "without a picture of the first frame that is shown until the stream is there");
  auto* ladder =
      command.add_flag("--ladder", arguments->ladder,
                       "with the streams of tvg ladder, between which the page changes by what the "
                       "line can carry");
  add_ladder_options(command, *arguments);
  command.get_option("--steps")->needs(ladder);
  command.add_option("--player", arguments->player,
                     "folder of the player's files, where they are not installed with the tool");
  command.callback([arguments, encoding] {
    arguments->encoding = given_of(encoding);
    run_page(*arguments);
  });
}

}  // namespace tvg::cli
