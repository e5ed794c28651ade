#include "cli/commands.hpp"
#include "cli/encode_job.hpp"
#include "cli/plan_file.hpp"
#include "tool/overwriting.hpp"
#include "tool/progress.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

#include <tvg/parts.hpp>

namespace tvg::cli {

namespace {

struct PlanArguments : EncodeArguments {
  std::string output;
  std::uint32_t parts = 0;
  bool json = false;
};

void print_plan(const PlanFile& plan, const PlanArguments& arguments) {
  if (arguments.json) {
    fmt::print("{}\n", nlohmann::json{{"plan", arguments.output},
                                      {"id", plan.id()},
                                      {"parts", plan.parts.size()},
                                      {"frames", plan.plan.frames},
                                      {"output", plan.path_of(plan.output)}}
                           .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  if (arguments.quiet) return;
  if (plan.parts.size() < arguments.parts) {
    fmt::print(stderr, "note: {} parts where {} were asked for: {} frames are encoded together ({})\n",
               plan.parts.size(), arguments.parts, plan.plan.frames_at_once,
               arguments.mode == "basis" ? "--period" : "--gop");
  }
  if (arguments.json) return;
  fmt::print(stderr,
             "{0}: {1} frames in {2} parts; tvg encode --plan {0} --part 1 makes the first, tvg join --plan "
             "{0} the whole\n",
             arguments.output, plan.plan.frames, plan.parts.size());
}

void run_plan(const PlanArguments& arguments, const CLI::App& command) {
  if (arguments.output == "-")
    throw ToolError(ExitStatus::kUsage, "a plan is a file beside its parts: give --output a name");
  EncodeOptions options = encode_options(arguments);
  files_of(arguments, arguments.measure.weights()).check_output(arguments.output);
  const OpenedInput opened = open_for_encoding(arguments, options);
  ProgressBar bar("reading", arguments.quiet);
  const auto progress = [&bar](std::uint64_t frames, std::optional<std::uint64_t> total) {
    bar.update(frames, total);
  };
  Result<EncodePlan> seen = plan_encoding(*opened.source, options, progress);
  if (!seen) throw tool_error(input_names(arguments), seen.error());
  bar.clear();
  PlanFile plan;
  plan.options = typed_options(command, arguments.output);
  plan.levels = options.levels;
  plan.plan = std::move(*seen);
  name_outputs(plan, arguments.output, cut_into_parts(plan.plan, arguments.parts));
  write_plan(plan, arguments.output);
  if (!arguments.quiet) print_later_notes(opened);
  print_plan(plan, arguments);
}

}  // namespace

void add_plan_command(CLI::App& tool) {
  auto arguments = std::make_shared<PlanArguments>();
  CLI::App& command = *tool.add_subcommand(
      "plan",
      "Look at an animation once, so that parts of it can be encoded on several machines; tvg encode --plan "
      "makes the parts, and tvg join --plan of them the very bytes that tvg encode makes");
  add_encode_options(command, *arguments);
  command
      .add_option("--parts", arguments->parts, "how many parts there are to be, if there are as many GOPs")
      ->required()
      ->check(CLI::Range(1u, 1000000u));
  command.add_option("-o,--output", arguments->output,
                     "the plan (default: named after the first input, beside it, as hand.plan.json)");
  command.add_flag("--json", arguments->json, "print what was planned as JSON on standard output");
  command.callback([arguments, &command] {
    if (arguments->output.empty())
      arguments->output = default_output(arguments->inputs.front(), ".plan.json");
    run_plan(*arguments, command);
  });
}

}  // namespace tvg::cli
