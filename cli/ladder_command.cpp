#include "cli/commands.hpp"
#include "cli/ladder_job.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace tvg::cli {

namespace {

struct LadderCommandArguments : LadderArguments {
  std::string output;
};

void run_ladder(const LadderCommandArguments& arguments) {
  check_ladder_options(arguments);
  const InputFiles inputs = files_of(arguments, arguments.measure.weights());
  for (const char* const name : {"high.tvg", "medium.tvg", "low.tvg", kLadderFile})
    inputs.check_output((std::filesystem::path(arguments.output) / name).string());
  AtomicFolder folder(arguments.output);
  write_ladder(arguments, folder);
  folder.finish();
  if (arguments.quiet) return;
  fmt::print(stderr, "{}: {} streams; tvg page {} -o FOLDER makes a page of them\n",
             (std::filesystem::path(arguments.output) / kLadderFile).string(), arguments.steps,
             arguments.output);
}

}  // namespace

void add_ladder_command(CLI::App& tool) {
  auto arguments = std::make_shared<LadderCommandArguments>();
  set_web_defaults(*arguments);
  CLI::App& command = *tool.add_subcommand(
      "ladder",
      "Make streams of one animation from fine to coarse, between which a player changes by what the line "
      "can carry");
  add_encode_options(command, *arguments, ", or a .tvg");
  command.add_option("-o,--output", arguments->output, "folder of the streams and of ladder.json")
      ->required();
  add_ladder_options(command, *arguments);
  command.callback([arguments] { run_ladder(*arguments); });
}

}  // namespace tvg::cli
