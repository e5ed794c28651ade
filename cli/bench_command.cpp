#include "cli/bench_job.hpp"
#include "cli/bench_report.hpp"
#include "cli/commands.hpp"
#include "tool/atomic_file.hpp"
#include "tool/mesh_format.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace tvg::cli {

namespace {

void check_outputs(const BenchArguments& arguments, const std::vector<BenchInput>& inputs) {
  if (arguments.json && arguments.csv == "-")
    throw ToolError(ExitStatus::kUsage,
                    "--json and --csv - both print to standard output: name a file for the CSV");
  if (!arguments.plot.empty() && !has_suffix(arguments.plot, ".svg"))
    fail_option("--plot", arguments.plot, "write rates.svg: plots are SVG");
  if (!arguments.plot.empty() && arguments.plot == arguments.csv)
    throw ToolError(ExitStatus::kUsage, fmt::format("{}: --csv and --plot need two files", arguments.plot));
  for (const BenchInput& input : inputs) {
    InputArguments one = arguments;
    one.inputs = input.files;
    const InputFiles files = files_of(one, arguments.measure.weights());
    for (const std::string& output : {arguments.csv, arguments.plot}) {
      if (!output.empty()) files.check_output(output);
    }
  }
}

void run_bench(const BenchArguments& arguments) {
  const BenchPlan plan = plan_bench(arguments);
  const std::vector<BenchInput> inputs = group_inputs(arguments.inputs);
  check_outputs(arguments, inputs);
  for (const std::string& name : plan.codecs.missing) {
    if (!arguments.quiet) fmt::print(stderr, "note: {} is left out: this tvg was built without it\n", name);
  }
  std::optional<AtomicFile> csv, plot;
  if (!arguments.csv.empty()) csv.emplace(arguments.csv).write(bench_csv_header());
  if (!arguments.plot.empty()) plot.emplace(arguments.plot);
  const bool for_people = !arguments.json && arguments.csv != "-";
  std::vector<BenchedAnimation> animations;
  for (const BenchInput& input : inputs) {
    animations.push_back(bench_animation(arguments, plan, input));
    if (csv) csv->write(bench_csv(animations.back()));
    if (!for_people) continue;
    fmt::print("{}\n", bench_table(animations.back()));
    std::fflush(stdout);
  }
  if (csv) csv->finish();
  if (plot) plot->write(bench_plots(animations));
  if (plot) plot->finish();
  if (arguments.json) fmt::print("{}", bench_json(animations));
  if (for_people) fmt::print("{}", bench_legend(arguments.runs));
}

void add_bench_outputs(CLI::App& command, BenchArguments& arguments) {
  command.add_option(
      "--csv", arguments.csv,
      "write comma-separated values too, a line for each row of the table; - prints them in its "
      "place");
  command.add_option("--plot", arguments.plot, "draw KG error and STED over bits per coordinate, as an SVG");
  command.add_flag("--json", arguments.json, "print the figures as JSON in place of the table");
  command.add_flag("-q,--quiet", arguments.quiet, "no progress bar and no notes");
}

}  // namespace

void add_bench_command(CLI::App& tool) {
  auto arguments = std::make_shared<BenchArguments>();
  arguments->bits = "7..13";
  arguments->threads = 1;
  CLI::App& command = *tool.add_subcommand(
      "bench",
      "Measure what size buys which error: animations in every mode at several resolutions, beside other "
      "codecs on the same lattice");
  add_input_options(command, *arguments,
                    ", or a .tvg. Several are one animation each; a cache goes with the mesh of its name, "
                    "else with the mesh before it; name sequences by folder or pattern");
  command
      .add_option("--bits", arguments->bits,
                  "bits per coordinate: ranges and lists (7..13, or 7,9,11), also of important and other "
                  "vertices (13:11, or 9:7..13:11)")
      ->capture_default_str();
  command
      .add_option("--mode", arguments->modes, "modes of TVG: some of elp, basis and lossless, as elp,basis")
      ->capture_default_str();
  command.add_option(
      "--codecs", arguments->codecs,
      fmt::format("what is measured: some of {} (default: tvg,draco,meshopt, as far as they are built in). "
                  "Others get the integers of the lattice, where it is one for all vertices and has at most "
                  "{} bits",
                  codec_names(), bench::kMostLatticeBits));
  add_measure_options(command, arguments->measure);
  add_mode_options(command, *arguments);
  add_effort_options(command, *arguments);
  command.add_option("--fps", arguments->fps, "sample a scene at this rate (default 30)");
  command.add_option(
      "--hausdorff", arguments->hausdorff,
      "measure the Hausdorff distance at every Nth frame; 0 leaves it out (default: at 10 frames or "
      "fewer)");
  command
      .add_option("--runs", arguments->runs,
                  "time the fastest of so many runs; after three seconds no further one is made")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      .add_option("--threads", arguments->threads,
                  "GOPs encoded at a time; times are of the processor, all threads together")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  add_bench_outputs(command, *arguments);
  command.callback([arguments] { run_bench(*arguments); });
}

}  // namespace tvg::cli
