#include "cli/ladder_job.hpp"

#include "cli/encode_job.hpp"
#include "cli/frames_in_memory.hpp"
#include "cli/simplified_source.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

#include <tvg/simplify.hpp>
#include <tvg/survey.hpp>

namespace tvg::cli {

namespace {

constexpr double kRateUnlessSaid = 30;
/// Two seconds as films go: who changes between streams waits so long at most.
constexpr const char* kPeriod = "64";
/// What a step has fewer than the best, in bits per coordinate; the last also in vertices, where that can be.
constexpr int kFewerBits = 2;
constexpr int kLeastBits = 6;
constexpr std::uint32_t kVertexRatio = 4;
/// Of less detail than this nothing can be spared.
constexpr std::uint32_t kLeastToSimplify = 1000;
constexpr std::uint64_t kHeldBytes = std::uint64_t{1} << 30;  // of frames that decide what is removed

/// Whether fewer vertices can carry all that a mesh has: not what belongs to faces, of which none is left.
bool can_be_simplified(const FrameSource& source) {
  const MeshProperties& properties = source.properties();
  const bool by_vertices =
      std::all_of(properties.attributes.begin(), properties.attributes.end(), [](const Attribute& attribute) {
        return attribute.domain == AttributeDomain::kVertex && !attribute.animated;
      });
  return by_vertices && properties.parts.empty() && source.mesh().vertex_count >= kLeastToSimplify;
}

/// The coding of a step that is so many bits coarser than the best.
EncodeOptions coarser(EncodeOptions options, int bits) {
  options.fine_bits = std::max(options.step ? options.fine_bits : kLeastBits, options.fine_bits - bits);
  options.coarse_bits = std::min(options.fine_bits, std::max(kLeastBits, options.coarse_bits - bits));
  if (options.step) *options.step = std::ldexp(*options.step, bits);
  if (options.max_error) options.max_error->value = std::ldexp(options.max_error->value, bits);
  return options;
}

StreamSurvey survey_file(const std::string& path) {
  StreamReader reader(path);
  const auto read = [&reader](std::uint64_t offset, std::span<std::uint8_t> bytes) {
    return Result<std::size_t>(reader.read_from(offset, bytes));
  };
  Result<StreamSurvey> stream = survey(read, reader.size());
  if (!stream) throw tool_error(reader.name(), stream.error());
  return std::move(*stream);
}

class LadderJob {
 public:
  LadderJob(const LadderArguments& arguments, AtomicFolder& folder)
      : arguments_(arguments),
        folder_(folder),
        options_(encode_options(arguments)),
        opened_(open_for_encoding(arguments, options_, InputKinds::kStreamsToo)),
        simplifiable_(can_be_simplified(*opened_.source)) {}

  std::string run() {
    static constexpr std::array<const char*, 3> kNames = {"high", "medium", "low"};
    for (unsigned step = 0; step < arguments_.steps; ++step) {
      const bool last = step + 1 == arguments_.steps;
      const std::string name = last && step > 0 ? kNames.back() : kNames.at(step);
      if (step == 0) {
        add_step(name, options_, *opened_.source);
      } else if (!last) {
        add_step(name, coarser(options_, kFewerBits), *opened_.source);
      } else if (!simplifiable_) {
        add_whole(name, "it changes, is small, or has what fewer vertices could not keep");
      } else {
        add_simplified(name);
      }
    }
    const nlohmann::json ladder = {{"tvg_ladder", 1},
                                   {"frame_rate", frame_rate_},
                                   {"frame_count", frames_},
                                   {"period_frames", period_},
                                   {"streams", streams_}};
    folder_.add(kLadderFile, ladder.dump(1) + "\n");
    if (!arguments_.quiet) print_later_notes(opened_);
    return best_;
  }

 private:
  /// The last step of a mesh that keeps its vertices.
  void add_whole(const std::string& name, const std::string& reason) {
    if (!arguments_.quiet)
      fmt::print(stderr, "note: {}.tvg has all vertices of the mesh: {}\n", name, reason);
    add_step(name, coarser(options_, 2 * kFewerBits), *opened_.source);
  }

  void add_simplified(const std::string& name) {
    SimplifyOptions wanted;
    wanted.importance = options_.importance;
    wanted.vertex_counts = {opened_.source->mesh().vertex_count / kVertexRatio};
    const std::string names = input_names(arguments_);
    rewind();
    ProgressBar reading("reading", arguments_.quiet);
    const FramesInMemory held =
        hold_frames(*opened_.source, {kHeldBytes, uses_skeleton(wanted.importance), names}, reading);
    reading.clear();
    ProgressBar bar("simplifying", arguments_.quiet, "vertices");
    const Result<Simplification> made =
        simplify(held.sequence.mesh, held.sequence.frames, opened_.source->skeleton(), held.joints, wanted,
                 [&bar](std::uint32_t removed, std::uint32_t total) { bar.update(removed, total); });
    bar.clear();
    if (!made) return add_whole(name, made.error().message);
    EncodeOptions options = coarser(options_, kFewerBits);
    options.fine_bits = options.coarse_bits;  // marks are of vertices that may be gone
    options.importance = {};
    options.levels = nullptr;
    SimplifiedSource source(*opened_.source, made->meshes.back(), SimplifiedSource::Keep::kAttributes);
    add_step(name, options, source);
  }

  void add_step(const std::string& name, const EncodeOptions& options, FrameSource& source) {
    rewind();
    AtomicFile& file = folder_.add(name + ".tvg");
    const auto sink = [&file](std::span<const std::uint8_t> bytes) {
      file.write(bytes.data(), bytes.size());
      return Status();
    };
    const EncodeReport report = encode_frames(source, options, sink, arguments_);
    file.flush();
    const StreamSurvey stream = survey_file(file.temporary_path());
    if (streams_.empty()) {
      best_ = file.temporary_path();
      take_facts(report, stream);
    }
    streams_.push_back(described(name, options, report, stream));
    if (!arguments_.quiet) print_encode_report(file.path(), report);
  }

  void take_facts(const EncodeReport& report, const StreamSurvey& stream) {
    frames_ = report.frames;
    simplifiable_ = simplifiable_ && report.meshes == 1;
    period_ = !stream.plans.empty() ? stream.plans.front().frame_count : stream.gops.front().frame_count;
    const auto fps = stream.metadata.find("fps");
    if (fps != stream.metadata.end()) frame_rate_ = parse_frame_rate(fps->second).value_or(kRateUnlessSaid);
  }

  nlohmann::json described(const std::string& name, const EncodeOptions& options, const EncodeReport& report,
                           const StreamSurvey& stream) const {
    double error = report.largest_error;
    for (const GopInfo& gop : stream.gops) {
      if (gop.mode == Mode::kElp)
        error = std::max(error, std::ldexp(gop.step, gop.fine_bits - gop.coarse_bits) / 2);
    }
    std::array<int, 2> bits = {options.coarse_bits, options.fine_bits};
    if (options.step) bits = {stream.gops.front().coarse_bits, stream.gops.front().fine_bits};
    return {{"file", name + ".tvg"},
            {"bytes", report.bytes},
            {"bits_per_second", std::llround(8 * static_cast<double>(report.bytes) * frame_rate_ /
                                             static_cast<double>(report.frames))},
            {"vertices", report.vertices},
            {"bits", bits},
            {"largest_error", error}};
  }

  void rewind() const {
    if (opened_.source->rewind()) return;
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("a ladder reads the input once for each of its streams, and {} can be read "
                                "only once: write it to a file first",
                                input_names(arguments_)));
  }

  const LadderArguments& arguments_;
  AtomicFolder& folder_;
  EncodeOptions options_;
  OpenedInput opened_;
  bool simplifiable_;
  double frame_rate_ = kRateUnlessSaid;
  std::uint64_t frames_ = 0;
  std::uint64_t period_ = 0;
  nlohmann::json streams_ = nlohmann::json::array();
  std::string best_;
};

}  // namespace

void set_web_defaults(EncodeArguments& arguments) {
  arguments.mode = "basis";
}

void add_ladder_options(CLI::App& command, LadderArguments& arguments) {
  command.add_option("--steps", arguments.steps, "how many streams: 2 (the best, and a small one) or 3")
      ->check(CLI::Range(2u, 3u))
      ->capture_default_str();
}

void check_ladder_options(const LadderArguments& arguments) {
  if (arguments.lossless) {
    throw ToolError(ExitStatus::kUsage,
                    "--lossless: a ladder is of coarser streams too, and these have nothing to go by; say "
                    "how fine the best shall be with --bits");
  }
  static_cast<void>(encode_options(arguments));
}

std::string write_ladder(const LadderArguments& given, AtomicFolder& folder) {
  LadderArguments arguments = given;
  if (arguments.mode == "basis" && arguments.period.empty()) arguments.period = kPeriod;
  return LadderJob(arguments, folder).run();
}

}  // namespace tvg::cli
