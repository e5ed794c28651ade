#include "cli/commands.hpp"
#include "cli/part_job.hpp"
#include "tool/atomic_file.hpp"
#include "tool/input_files.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <sys/resource.h>
#include <utility>

#include <tvg/join.hpp>

namespace tvg::cli {

namespace {

struct JoinArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::string frames;
  std::string plan;
  bool quiet = false;
};

/// All inputs are open at once: as many as the system lets this process have.
void allow_many_open_files() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
  limit.rlim_cur = limit.rlim_max;
  static_cast<void>(setrlimit(RLIMIT_NOFILE, &limit));
}

/// With the parts and, unless it was named, the output of a plan.
JoinArguments with_planned(JoinArguments arguments) {
  if (arguments.plan.empty()) return arguments;
  PlannedJoin planned = planned_join(arguments.plan);
  arguments.inputs = std::move(planned.inputs);
  if (arguments.output.empty()) arguments.output = std::move(planned.output);
  return arguments;
}

void run_join(const JoinArguments& arguments) {
  JoinOptions options;
  if (!arguments.frames.empty()) {
    const FrameRange range = parse_frame_range(arguments.frames);
    options.frames = FrameRange{range.first, range.last};
  }
  if (std::count(arguments.inputs.begin(), arguments.inputs.end(), "-") > 1) {
    throw ToolError(ExitStatus::kUsage, "standard input (-) can be joined once only");
  }
  InputFiles files;
  files.add(arguments.inputs);
  files.check_output(arguments.output);
  allow_many_open_files();
  std::vector<JoinInput> inputs;
  for (const std::string& path : arguments.inputs) inputs.push_back(open_join_input(path));

  AtomicFile file(arguments.output);
  const auto sink = [&file](std::span<const std::uint8_t> bytes) {
    file.write(bytes.data(), bytes.size());
    return Status();
  };
  ProgressBar bar("joining", arguments.quiet);
  const auto progress = [&bar](std::uint64_t frames, std::optional<std::uint64_t> total) {
    bar.update(frames, total);
  };
  const Result<JoinReport> report = join(std::move(inputs), options, sink, progress);
  if (!report) throw tool_error(report.error());
  file.finish();

  if (arguments.quiet) return;
  bar.clear();
  for (const std::string& note : report->notes) fmt::print(stderr, "note: {}\n", note);
  fmt::print(stderr, "{}: {} frames in {} GOPs, {}\n",
             arguments.output == "-" ? "standard output" : arguments.output, report->frames, report->gops,
             readable_bytes(report->bytes));
}

}  // namespace

void add_join_command(CLI::App& tool) {
  auto arguments = std::make_shared<JoinArguments>();
  CLI::App& command = *tool.add_subcommand(
      "join",
      "Make one .tvg of several, or cut one, without encoding anew. GOPs are copied byte for byte, whatever "
      "mesh, lattice or options they were made with.");
  auto* inputs =
      command.add_option("input", arguments->inputs, "the streams in their order; - for standard input");
  command.add_option("-o,--output", arguments->output,
                     "the stream to write; - for standard output (default: with --plan, as that names it)");
  command
      .add_option("--plan", arguments->plan,
                  "instead of inputs: the parts that tvg plan has planned; all have to be there")
      ->excludes(inputs);
  command.add_option(
      "--frames", arguments->frames,
      "keep frames A-B only, counted from 0 over all inputs; they must begin and end with a GOP "
      "(tvg info shows the GOPs)");
  command.add_flag("-q,--quiet", arguments->quiet, "print errors only");
  command.callback([arguments] {
    if (arguments->plan.empty() && arguments->inputs.empty()) throw CLI::RequiredError("input");
    if (arguments->plan.empty() && arguments->output.empty()) throw CLI::RequiredError("--output");
    run_join(with_planned(*arguments));
  });
}

}  // namespace tvg::cli
