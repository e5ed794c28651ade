#include "cli/commands.hpp"
#include "cli/look_options.hpp"
#include "cli/number_option.hpp"
#include "cli/open_source_files.hpp"
#include "encoder/importers/scene_file.hpp"
#include "player/playback/playback_clock.hpp"
#include "player/window/play_window.hpp"
#include "tool/input_files.hpp"
#include "tool/option_values.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include <tvg/levels.hpp>

namespace tvg::cli {

namespace {

constexpr double kMostSeconds = 1e6;

struct PlayArguments : player::LookArguments {
  ShownMeasureArguments measure;
  std::string location;
  std::string fps;
  std::string screenshot;
  std::string report;
  double speed = 1;
  double seconds = 0;
  std::uint64_t start = 0;
  std::uint32_t lod = 0;
  std::uint64_t memory_mb = 512;
  bool once = false;
  bool paused = false;
};

player::PlayOptions options_of(const PlayArguments& arguments) {
  player::PlayOptions options;
  static_cast<player::Look&>(options) = player::parse_look(arguments);
  options.open_source = source_opener();
  options.measure = shown_measure(arguments.measure, true);
  options.location = arguments.location;
  if (!arguments.fps.empty()) options.rate = parse_rate(arguments.fps);
  options.speed = arguments.speed;
  options.looping = !arguments.once;
  options.paused = arguments.paused;
  options.start = arguments.start;
  options.lod = arguments.lod;
  options.memory_bytes = arguments.memory_mb << 20;
  InputFiles inputs;
  inputs.add(options.location);
  inputs.add(with_scene_files(options.reference));
  inputs.add(arguments.measure.cost.weights());
  inputs.add(arguments.measure.skeleton);
  inputs.check_output(arguments.screenshot);
  inputs.check_output(arguments.report);
  options.screenshot = arguments.screenshot;
  options.report = arguments.report;
  if (arguments.seconds > 0) options.seconds = arguments.seconds;
  return options;
}

}  // namespace

void add_play_command(CLI::App& tool) {
  auto arguments = std::make_shared<PlayArguments>();
  CLI::App& command =
      *tool.add_subcommand("play", "Play a stream in a window, from a file or while it arrives");
  command.add_option(
      "input", arguments->location,
      "a .tvg, an http or https URL of one, or - for standard input; a file can also be dropped on "
      "the window");
  add_look_options(command, *arguments, arguments->measure);
  add_count(
      command, "--start", [arguments](std::uint64_t frame) { arguments->start = frame; },
      "the first frame to show, counted from 0");
  command.add_flag("--paused", arguments->paused, "wait at the first frame");
  command.add_flag("--once", arguments->once, "stop at the end instead of beginning again");
  command.add_option("--fps", arguments->fps,
                     "frames per second, instead of the stream's own: 30, 30000/1001");
  add_number(
      command, "--speed", {player::PlaybackClock::kSlowest, player::PlaybackClock::kFastest},
      [arguments](double value) { arguments->speed = value; }, "times the frame rate")
      ->default_str("1");
  command
      .add_option(
          "--lod", arguments->lod,
          "play the coarser mesh of this number that the stream has, 1 the first; in mode basis fewer "
          "bytes are read for it (default: 0, the whole)")
      ->check(CLI::Range(0u, kMaxCoarseMeshes));
  command.add_option("--memory", arguments->memory_mb, "MiB of decoded frames held at most")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  add_number(
      command, "--seconds", {0, kMostSeconds, true},
      [arguments](double value) { arguments->seconds = value; }, "close after so long");
  command.add_option("--screenshot", arguments->screenshot,
                     "save the window with the first frame as .png, and close");
  command.add_option("--report", arguments->report, "write how playing went as JSON, when the window closes");
  command.callback([arguments] { player::run_play_window(options_of(*arguments)); });
}

}  // namespace tvg::cli
