#include "cli/commands.hpp"
#include "cli/encode_job.hpp"
#include "cli/part_job.hpp"
#include "cli/plan_file.hpp"
#include "encoder/live/live_encoding.hpp"
#include "encoder/live/stream_output.hpp"
#include "tool/option_values.hpp"
#include "tool/overwriting.hpp"
#include "tool/progress.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace tvg::cli {

namespace {

constexpr double kUsualFrameRate = 30;

struct EncodeCommandArguments : EncodeArguments {
  std::string output;
  bool loop = false;
  bool json = false;
  std::string plan;
  std::optional<std::uint32_t> part;
};

/// How the frames come: a pipe's when they come, others at their rate.
LiveInput live_input(const EncodeCommandArguments& arguments, const Metadata& metadata) {
  LiveInput input;
  input.open_ended =
      std::find(arguments.inputs.begin(), arguments.inputs.end(), "-") != arguments.inputs.end();
  input.loop = arguments.loop;
  if (input.open_ended) {
    if (input.loop) throw ToolError(ExitStatus::kUsage, "--loop needs a file: a pipe cannot be read twice");
    return input;
  }
  const auto known = metadata.find("fps");
  const std::string fps =
      !arguments.fps.empty() ? arguments.fps : (known != metadata.end() ? known->second : "");
  input.pace = fps.empty() ? kUsualFrameRate : parse_frame_rate(fps);
  if (!input.pace) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("--live needs a frame rate such as 30 or 30000/1001, not {}", fps));
  }
  return input;
}

/// Sends each GOP as soon as it is complete.
EncodeReport encode_as_it_comes(const EncodeCommandArguments& arguments, const EncodeOptions& options,
                                FrameSource& source, const ByteSink& sink) {
  const LiveInput live = live_input(arguments, source.metadata());
  ProgressBar bar("encoding", arguments.quiet);
  const auto progress = [&bar](std::uint64_t frames, std::optional<std::uint64_t> total) {
    bar.update(frames, total);
  };
  Result<LiveReport> report = encode_live(source, options, live, sink, progress);
  if (!report) throw tool_error(input_names(arguments), report.error());
  bar.clear();
  if (report->cut_short && !arguments.quiet)
    fmt::print(stderr, "note: {}: that frame is left out\n", *report->cut_short);
  report->box_of_each_gop = false;  // as is expected of what comes live
  return *report;
}

void run_encode(const EncodeCommandArguments& arguments) {
  const auto begun = std::chrono::steady_clock::now();
  if (arguments.json && arguments.output == "-") {
    throw ToolError(ExitStatus::kUsage,
                    "--json prints to standard output, where -o - writes the stream: name a file");
  }
  EncodeOptions options = encode_options(arguments);
  files_of(arguments, arguments.measure.weights()).check_output(arguments.output);
  if (arguments.live && arguments.levels.any())
    throw ToolError(ExitStatus::kUsage,
                    "--levels simplify and --lod need all frames in advance: not with --live");
  const OpenedInput opened = open_for_encoding(arguments, options);
  const std::unique_ptr<StreamOutput> output = open_stream_output(arguments.output, arguments.live);
  const auto sink = [&output](std::span<const std::uint8_t> bytes) {
    output->write(bytes);
    return Status();
  };
  const EncodeReport report = arguments.live ? encode_as_it_comes(arguments, options, *opened.source, sink)
                                             : encode_frames(*opened.source, options, sink, arguments);
  output->finish();
  if (arguments.json) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    print_encode_json(arguments.output, report, taken.count());
  }
  if (arguments.quiet) return;
  print_later_notes(opened);
  if (arguments.json) return;
  print_encode_report(arguments.output == "-" ? "standard output" : arguments.output, report);
}

/// Part of what was planned: all else is said by the plan.
void run_planned(const EncodeCommandArguments& arguments, const CLI::App& command) {
  const std::array own = {"--plan", "--part", "--output", "--threads", "--quiet", "--json", "--force"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option_name(*option);
    if (option->count() == 0 || std::find(own.begin(), own.end(), name) != own.end()) continue;
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("{}: not with --plan, in which all is said of inputs and how they are encoded", name));
  }
  PartArguments parts{arguments.plan, arguments.part, arguments.output, arguments.threads,
                      false,          arguments.json, arguments.quiet};
  parts.again = command.count("--force") > 0;
  run_parts(parts);
}

void add_plan_options(CLI::App& command, EncodeCommandArguments& arguments) {
  auto* plan = command.add_option(
      "--plan", arguments.plan,
      "instead of inputs: encode what tvg plan has planned, and with it how; parts that are there and whole "
      "are not made again (but with --force)");
  command
      .add_option("--part", arguments.part,
                  "with --plan: this part alone, from 1 on (default: all, one after the other)")
      ->needs(plan)
      ->check(CLI::Range(1u, 1000000u));
}

/// What the head says of meshes to come, where the input cannot be looked through before.
void add_mesh_bounds(CLI::App& command, EncodeArguments& arguments) {
  command
      .add_option("--max-vertices", arguments.max_vertices,
                  "vertices of the largest mesh to come, where frames are read only once (default: those of "
                  "the first mesh)")
      ->check(CLI::Range(1u, kMaxVertexCount));
  command
      .add_option("--max-faces", arguments.max_faces,
                  "faces of the largest mesh to come (default: those of the first mesh)")
      ->check(CLI::Range(1u, kMaxFaceCount));
  command
      .add_option(
          "--max-meshes", arguments.max_meshes,
          "how many of the last meshes a decoder keeps at least, so that they can come again (default: "
          "as many as pay, up to 16; where frames are read only once, 1)")
      ->check(CLI::Range(1u, kMaxMeshesInForce));
}

}  // namespace

void add_encode_command(CLI::App& tool) {
  auto arguments = std::make_shared<EncodeCommandArguments>();
  CLI::App& command = *tool.add_subcommand("encode", "Make a .tvg of a mesh sequence");
  add_encode_options(command, *arguments);
  command.add_option("-o,--output", arguments->output,
                     "the stream to write; - for standard output; an http or https URL for an upload by PUT "
                     "(default: named after the first input, beside it)");
  add_mesh_bounds(command, *arguments);
  add_plan_options(command, *arguments);
  command.get_option("input")->required(false);  // for they may be planned
  command.add_flag("--json", arguments->json, "print the report as JSON on standard output");
  auto* live =
      command
          .add_flag("--live", arguments->live,
                    "send each GOP as soon as it is complete: frames from a pipe as they come, until "
                    "it ends; those of a file at its frame rate (--fps, or 30)")
          ->excludes("--threads");
  command.add_flag("--loop", arguments->loop, "with --live: begin the file again at its end, until stopped")
      ->needs(live);
  command.callback([arguments, &command] {
    if (!arguments->plan.empty()) return run_planned(*arguments, command);
    if (arguments->inputs.empty()) throw CLI::RequiredError("input");
    if (arguments->output.empty()) arguments->output = default_output(arguments->inputs.front(), ".tvg");
    run_encode(*arguments);
  });
}

}  // namespace tvg::cli
