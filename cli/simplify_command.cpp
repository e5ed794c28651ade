#include "cli/commands.hpp"
#include "cli/number_option.hpp"
#include "cli/simplify_job.hpp"
#include "tool/option_values.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

#include <tvg/simplify.hpp>

namespace tvg::cli {

namespace {

void add_target_options(CLI::App& command, SimplifyArguments& arguments) {
  add_number(
      command, "--ratio", {1}, [&arguments](double ratio) { arguments.ratio = ratio; },
      "how many times fewer vertices there shall be");
  add_count(
      command, "--vertices", [&arguments](std::uint64_t count) { arguments.vertices = count; },
      "instead: how many vertices there shall be");
  arguments.cost.option = "--priority";
  command
      .add_option("--priority", arguments.cost.criteria,
                  fmt::format("what is removed first: maps (what is small and flat, Eq. 7), or what matters "
                              "least by criteria with weights, as curv or curv+0.5*skel; {}",
                              criterion_names()))
      ->capture_default_str();
  add_criterion_options(command, arguments.cost);
  add_number(
      command, "--lambda", {0, 1}, [&arguments](double lambda) { arguments.lambda = lambda; },
      fmt::format("of --priority maps: weight of the area against the curvature (default {})",
                  SimplifyOptions().lambda));
  add_count(
      command, "--remesh",
      [&arguments](std::uint64_t levels) {
        if (levels > kMaxRemeshLevels)
          fail_option("--remesh", std::to_string(levels), fmt::format("at most {}", kMaxRemeshLevels));
        arguments.remesh = static_cast<std::uint32_t>(levels);
      },
      "then cut every face in four so often, with the new vertices on the original");
  add_number(
      command, "--remesh-distance", {0}, [&arguments](double most) { arguments.remesh_distance = most; },
      "cut only where the original is further away than this, in the mesh's units");
  command.add_flag(
      "--per-keyframe", arguments.per_keyframe,
      "simplify every frame by itself, as the paper does, instead of all with one connectivity; for "
      "mesh files and .tvg");
}

void add_output_options(CLI::App& command, SimplifyArguments& arguments) {
  command.add_option("--bits", arguments.bits, "of a .tvg: bits per coordinate (default 11)");
  command.add_option("--mode", arguments.mode, "of a .tvg: elp or basis (default elp)")
      ->check(CLI::IsMember({"elp", "basis"}));
  command.add_option("--report", arguments.report,
                     "write quadric errors of levels and frames, and distances: a table (.csv), all there is "
                     "(.json), or plots (.svg)");
  command
      .add_option(
          "--distance-stride", arguments.distance_stride,
          "measure the distance from the original at every Nth frame (default: at 50 frames or fewer)")
      ->check(CLI::PositiveNumber);
  command.add_flag("--no-distance", arguments.no_distance, "do not measure it");
  command
      .add_option(
          "--memory", arguments.memory,
          "megabytes for frames that decide what is removed; where all do not fit, evenly spread ones do")
      ->check(CLI::Range(1u, 1u << 20))
      ->capture_default_str();
  command.add_flag("--json", arguments.json, "print everything as JSON");
  command.add_flag("-q,--quiet", arguments.quiet, "print errors only");
}

}  // namespace

void add_simplify_command(CLI::App& tool) {
  auto arguments = std::make_shared<SimplifyArguments>();
  CLI::App& command = *tool.add_subcommand(
      "simplify", "Reduce the vertices of an animation and keep what moves, with one mesh for all frames");
  add_input_options(command, arguments->input, ", or a .tvg");
  command.add_option("--fps", arguments->input.fps,
                     "frames per second at which a scene is sampled (default 30)");
  command
      .add_option(
          "-o,--output", arguments->output,
          "a .tvg, a cache (small.pc2, small.mdd; the mesh goes beside it as OBJ; - for PC2 on standard "
          "output) or a sequence of mesh files (small_%04d.obj, .ply, .off, .stl)")
      ->required();
  add_target_options(command, *arguments);
  add_output_options(command, *arguments);
  command.callback([arguments] { run_simplify(*arguments); });
}

}  // namespace tvg::cli
