#include "cli/encode_options.hpp"

#include "tool/option_values.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <thread>

namespace tvg::cli {

namespace {

constexpr int kMostBits = 24;
constexpr int kMostThreads = 1024;
constexpr std::uint32_t kLiveGopFrames = 15;  // who joins a live stream waits half a second at most
constexpr std::uint32_t kBasisGopFrames = 32;

Metadata metadata_of(const EncodeArguments& arguments) {
  Metadata metadata;
  for (const std::string& entry : arguments.metadata) {
    const std::size_t equals = entry.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw ToolError(ExitStatus::kUsage, fmt::format("--meta {}: write it as KEY=VALUE", entry));
    }
    metadata[entry.substr(0, equals)] = entry.substr(equals + 1);
  }
  if (const auto fps = metadata.find("fps"); fps != metadata.end() && !parse_frame_rate(fps->second)) {
    fail_option("--meta", "fps=" + fps->second, kFrameRateHelp);
  }
  for (const auto& [key, value] : {std::pair("fps", &arguments.fps), std::pair("name", &arguments.name),
                                   std::pair("units", &arguments.units), std::pair("up", &arguments.up)}) {
    if (!value->empty()) metadata[key] = *value;
  }
  return metadata;
}

/// Frames of a period: a number, or all there are.
std::uint32_t parse_period(const std::string& text) {
  constexpr std::uint32_t kMost = 65536;
  if (text == "all") return kMost;
  std::uint32_t frames = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), frames);
  if (error != std::errc() || end != text.data() + text.size() || frames == 0 || frames > kMost)
    fail_option("--period", text, "write a number of frames from 1 to 65536, or all");
  return frames;
}

/// A length in the mesh's units, or a share of the diagonal: 0.05%.
ErrorBound parse_error_bound(const std::string& text) {
  ErrorBound bound;
  const bool share = !text.empty() && text.back() == '%';
  const char* const last = text.data() + text.size() - (share ? 1 : 0);
  const auto [end, error] = std::from_chars(text.data(), last, bound.value);
  if (error != std::errc() || end != last || !(bound.value > 0) || !std::isfinite(bound.value))
    fail_option("--max-error", text,
                "write a length in the mesh's units (0.01), or a share of the diagonal (0.05%)");
  bound.of_diagonal = share;
  if (share) bound.value /= 100;
  return bound;
}

/// Mode elp and mode basis each have options that mean nothing to the other.
void check_mode(const EncodeArguments& arguments) {
  if (arguments.mode == "basis" && arguments.predictor != "elp")
    throw ToolError(ExitStatus::kUsage, "--predictor is of --mode elp: a basis has none to choose from");
  if (arguments.mode != "basis" && !arguments.period.empty())
    throw ToolError(ExitStatus::kUsage,
                    "--period needs --mode basis, whose planes the frames of a period share");
}

/// How positions are coded: what there is to choose of it, or that nothing is.
void add_coding_options(CLI::App& command, EncodeArguments& arguments) {
  const std::size_t before = command.get_options().size();
  auto* bits = command
                   .add_option("--bits", arguments.bits,
                               "bits per coordinate of important and of other vertices (13:11), or of all")
                   ->capture_default_str();
  command
      .add_option("--step", arguments.step,
                  "instead of bits: lattice steps in the mesh's units (0.01:0.04), or one for all; no "
                  "coordinate is off by more than half a step, but for the rounding of decoded positions "
                  "to float32")
      ->excludes(bits);
  command
      .add_option(
          "--max-error", arguments.max_error,
          "instead of bits: what no coordinate may be off by more, in the mesh's units (0.01) or as a "
          "share of the diagonal of the sequence's box (0.05%)")
      ->excludes(bits)
      ->excludes("--step");
  add_measure_options(command, arguments.measure);
  command
      .add_option("--mode", arguments.mode,
                  "how frames are coded: elp, each from those before it; or basis, sums of planes that a "
                  "period shares, for far smaller files")
      ->check(CLI::IsMember({"elp", "basis"}))
      ->capture_default_str();
  add_mode_options(command, arguments);
  const std::vector<CLI::Option*> choices = command.get_options();
  auto* lossless = command.add_flag(
      "--lossless", arguments.lossless,
      "keep every bit of the float32 positions; there is nothing to choose then of bits, step, "
      "importance, mode and predictor");
  for (std::size_t i = before; i < choices.size(); ++i) lossless->excludes(choices[i]);
}

}  // namespace

EncodeOptions encode_options(const EncodeArguments& arguments) {
  check_mode(arguments);
  EncodeOptions options;
  options.mode = arguments.lossless ? Mode::kLossless : arguments.mode == "basis" ? Mode::kBasis : Mode::kElp;
  options.effort = arguments.effort;
  if (!arguments.period.empty()) options.period_frames = parse_period(arguments.period);
  if (!arguments.max_error.empty()) options.max_error = parse_error_bound(arguments.max_error);
  if (arguments.step.empty()) {
    const BitPair bits = parse_bits(arguments.bits);
    options.fine_bits = bits.fine;
    options.coarse_bits = bits.coarse;
  } else {
    const StepPair step = parse_step(arguments.step);
    options.step = step.fine;
    options.fine_bits = kMostBits;
    options.coarse_bits = kMostBits - step.shift;
  }
  if (arguments.measure.any() && options.fine_bits == options.coarse_bits) {
    throw ToolError(ExitStatus::kUsage,
                    "--measure, --important and what goes with them need two resolutions, for example --bits "
                    "13:11");
  }
  options.importance = importance_of(arguments.measure);
  options.predictor = std::map<std::string, Predictor>{
      {"space", Predictor::kSpace},
      {"time", Predictor::kTime},
      {"elp", Predictor::kElp},
      {"pyramid", Predictor::kPyramid},
      {"auto",
       Predictor::kAuto}}.at(arguments.predictor);
  const std::uint32_t usual_gop = options.mode == Mode::kBasis ? kBasisGopFrames : options.gop_frames;
  options.gop_frames = arguments.gop.value_or(arguments.live ? kLiveGopFrames : usual_gop);
  options.keep_vertex_order = !arguments.reorder;
  options.suit_captured = !arguments.keep_order;
  options.max_vertices = arguments.max_vertices;
  options.max_faces = arguments.max_faces;
  options.max_meshes = arguments.max_meshes;
  options.threads =
      arguments.threads != 0 ? arguments.threads : std::max(1u, std::thread::hardware_concurrency());
  if (arguments.live && arguments.period.empty()) options.period_frames = options.gop_frames;
  if (arguments.live) options.threads = 1;  // with more, a GOP would wait for those that follow it
  options.metadata = metadata_of(arguments);
  options.attribute_bits = attribute_bits(arguments);
  return options;
}

void add_mode_options(CLI::App& command, EncodeArguments& arguments) {
  command.add_option("--period", arguments.period,
                     "in mode basis: frames that share planes, or all; more make smaller files that take "
                     "longer to begin (default 128; with --live the GOP)");
  command
      .add_option("--predictor", arguments.predictor,
                  "what vertices are predicted from: elp as the paper has it, pyramid for "
                  "smaller files, auto for the smaller of the two in each frame")
      ->check(CLI::IsMember({"space", "time", "elp", "pyramid", "auto"}))
      ->capture_default_str();
}

void add_effort_options(CLI::App& command, EncodeArguments& arguments) {
  command
      .add_option(
          "--effort", arguments.effort,
          "1 (fast) to 9 (small): what mode basis tries, and neighbours that the pyramid predicts from")
      ->check(CLI::Range(1, 9))
      ->capture_default_str();
  command
      .add_option("--gop", arguments.gop,
                  "frames that can be decoded on their own (default 50; in mode basis 32; with --live 15)")
      ->check(CLI::Range(1, 65536));
}

void add_encode_options(CLI::App& command, EncodeArguments& arguments, const std::string& others) {
  add_input_options(command, arguments, others);
  add_coding_options(command, arguments);
  add_effort_options(command, arguments);
  add_level_options(command, arguments.levels);
  add_property_options(command, arguments);
  auto* reorder = command.add_flag("--reorder", arguments.reorder,
                                   "give up the vertex order, which saves about a byte per vertex");
  command
      .add_flag("--keep-order", arguments.keep_order,
                "keep the vertex order, and code frames as otherwise, even where each has a mesh of its own")
      ->excludes(reorder);
  command.add_option("--fps", arguments.fps,
                     "frames per second, kept with the stream (30, 30000/1001); a scene is sampled at it "
                     "(default 30)");
  command.add_option("--name", arguments.name, "a name, kept with the stream");
  command.add_option("--units", arguments.units, "length of one unit (m, cm, ...), kept with the stream");
  command.add_option("--up", arguments.up, "the axis that is up, kept with the stream")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command.add_option("--meta", arguments.metadata, "KEY=VALUE to keep with the stream; may be repeated");
  command.add_option("--threads", arguments.threads, "GOPs encoded at a time (default: one per processor)")
      ->check(CLI::Range(1, kMostThreads));
  command.add_flag("-q,--quiet", arguments.quiet, "print errors only");
}

}  // namespace tvg::cli
