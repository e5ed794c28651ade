#include "cli/bench_job.hpp"

#include "cli/frames_in_memory.hpp"
#include "codecs/errors.hpp"
#include "codecs/in_memory.hpp"
#include "codecs/timing.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <utility>

namespace tvg::cli {

namespace {

constexpr std::uint64_t kAllBytes = std::numeric_limits<std::uint64_t>::max();
/// Frames at which the Hausdorff distance is measured, at most, unless a stride says it: it takes longer than
/// all else.
constexpr std::uint64_t kUsualMeasuredFrames = 10;
constexpr int kMostBasisBits = 16;

/// The options of `tvg encode` that make one row; what another mode has to choose is left as it is.
EncodeArguments arguments_of_row(const BenchArguments& arguments, Mode mode, const BitPair& bits) {
  EncodeArguments one = arguments;
  one.mode = mode == Mode::kBasis ? "basis" : "elp";
  one.lossless = mode == Mode::kLossless;
  one.bits = fmt::format("{}:{}", bits.fine, bits.coarse);
  if (mode == Mode::kBasis) one.predictor = EncodeArguments().predictor;
  if (mode != Mode::kBasis) one.period.clear();
  if (bits.fine == bits.coarse) one.measure = {};
  return one;
}

bool has_two_resolutions(const BitPair& bits) {
  return bits.fine != bits.coarse;
}

class AnimationBench {
 public:
  AnimationBench(const BenchArguments& arguments, const BenchPlan& plan, const BenchInput& input)
      : arguments_(arguments), plan_(plan) {
    result_.input = input;
    arguments_.inputs = input.files;
    names_ = input_names(arguments_);
  }

  BenchedAnimation run() {
    read();
    ProgressBar bar(fmt::format("measuring {}", result_.input.name), arguments_.quiet, "rows");
    bar_ = &bar;
    if (plan_.codecs.tvg) {
      for (const Mode mode : plan_.modes) add_rows_of(mode);
    }
    for (const bench::OtherCodec& codec : plan_.codecs.others) {
      for (const BitPair& bits : plan_.bits) {
        if (is_for_others(bits)) add_other(codec, bits);
      }
    }
    bar.clear();
    tell_of_left_out();
    return std::move(result_);
  }

 private:
  /// All frames into memory; what is there beside positions is left.
  void read() {
    const OpenedInput opened = open_input_or_stream(arguments_);
    if (!arguments_.quiet) print_notes(opened);
    first_frame_ = opened.first_frame;
    const auto two = std::find_if(plan_.bits.begin(), plan_.bits.end(), has_two_resolutions);
    Importance importance;
    if (two != plan_.bits.end()) {
      importance = encode_options(arguments_of_row(arguments_, Mode::kElp, *two)).importance;
      check_measure(arguments_.measure, importance, *opened.source, arguments_.inputs);
    }
    ProgressBar bar(fmt::format("reading {}", result_.input.name), arguments_.quiet);
    FramesInMemory held = hold_frames(*opened.source, {kAllBytes, two != plan_.bits.end(), names_}, bar);
    bar.clear();
    if (!arguments_.quiet) print_later_notes(opened);
    sequence_ = std::move(held.sequence);
    joints_ = {opened.source->skeleton(), std::move(held.joints)};
    result_.vertices = sequence_.mesh.vertex_count;
    result_.faces = sequence_.mesh.faces.size();
    result_.frames = sequence_.frames.size();
    result_.hausdorff_stride = arguments_.hausdorff.value_or(
        static_cast<std::uint32_t>((result_.frames + kUsualMeasuredFrames - 1) / kUsualMeasuredFrames));
  }

  bool is_for_others(const BitPair& bits) const {
    return bits.fine == bits.coarse && bits.fine <= bench::kMostLatticeBits;
  }

  ComparisonReport errors_of(const std::vector<FramePositions>& decoded) {
    const ComparisonReport errors = bench::compare(
        sequence_, decoded, {result_.hausdorff_stride > 0, std::max(1u, result_.hausdorff_stride)});
    result_.diagonal = errors.diagonal;
    return errors;
  }

  void add_rows_of(Mode mode) {
    if (mode == Mode::kLossless) return add_tvg(mode, std::nullopt);
    for (const BitPair& bits : plan_.bits) add_tvg(mode, bits);
  }

  void add_tvg(Mode mode, const std::optional<BitPair>& bits) {
    EncodeOptions options =
        encode_options(arguments_of_row(arguments_, mode, bits.value_or(BitPair{11, 11})));
    options.first_frame = first_frame_;
    BenchRow row{"tvg", name_of(mode), bits, 0, {}, 0, 0};
    std::vector<std::uint8_t> stream;
    row.encode_seconds = bench::best_time(arguments_.runs, [&] {
      SequenceSource source(sequence_, &joints_);
      stream = bench::encode_to_memory(source, options, names_);
    });
    row.bytes = stream.size();
    std::vector<FramePositions> decoded(sequence_.frames.size(),
                                        FramePositions(3 * std::size_t{sequence_.mesh.vertex_count}));
    row.decode_seconds =
        bench::best_time(arguments_.runs, [&] { bench::decode_from_memory(stream, decoded); });
    row.errors = errors_of(decoded);
    add(std::move(row));
  }

  void add_other(const bench::OtherCodec& codec, const BitPair& bits) {
    const bench::Lattice lattice = bench::quantize(sequence_, bits.fine);
    bench::CodecResult made;
    try {
      made = codec.run(lattice.indices, arguments_.runs);
    } catch (const std::exception& error) {
      left_out_.push_back(fmt::format("{} at {} bits: {}", codec.name, bits.fine, error.what()));
    }
    if (made.exact) {
      // The errors are those of the lattice, whatever codec brings its integers back.
      const auto [errors, is_new] = lattice_errors_.try_emplace(bits.fine);
      if (is_new) errors->second = errors_of(lattice.centres());
      add({std::string(codec.name), "", bits, made.bytes, errors->second, made.encode_seconds,
           made.decode_seconds});
    } else if (made.bytes > 0) {
      left_out_.push_back(
          fmt::format("{} at {} bits does not give back what it was given", codec.name, bits.fine));
    }
  }

  void add(BenchRow row) {
    result_.rows.push_back(std::move(row));
    bar_->update(result_.rows.size(), row_count());
  }

  std::uint64_t row_count() const {
    std::uint64_t count = 0;
    for (const Mode mode : plan_.modes) count += mode == Mode::kLossless ? 1 : plan_.bits.size();
    if (!plan_.codecs.tvg) count = 0;
    const auto shared = std::count_if(plan_.bits.begin(), plan_.bits.end(),
                                      [this](const BitPair& bits) { return is_for_others(bits); });
    return count + static_cast<std::uint64_t>(shared) * plan_.codecs.others.size();
  }

  void tell_of_left_out() const {
    if (arguments_.quiet) return;
    for (const std::string& what : left_out_)
      fmt::print(stderr, "note: {}: left out: {}\n", result_.input.name, what);
  }

  BenchArguments arguments_;
  const BenchPlan& plan_;
  std::string names_;
  std::uint64_t first_frame_ = 0;
  Sequence sequence_;
  JointTracks joints_;
  std::map<int, ComparisonReport> lattice_errors_;  ///< by bits
  std::vector<std::string> left_out_;
  ProgressBar* bar_ = nullptr;
  BenchedAnimation result_;
};

}  // namespace

BenchPlan plan_bench(const BenchArguments& arguments) {
  BenchPlan plan{parse_bit_list(arguments.bits), parse_mode_list(arguments.modes),
                 arguments.codecs.empty() ? usual_codecs() : parse_codec_list(arguments.codecs)};
  const auto has_mode = [&plan](Mode mode) {
    return std::find(plan.modes.begin(), plan.modes.end(), mode) != plan.modes.end();
  };
  const bool two = std::any_of(plan.bits.begin(), plan.bits.end(), has_two_resolutions);
  if (arguments.measure.any() && !two) {
    throw ToolError(ExitStatus::kUsage,
                    "--measure, --important and what goes with them need two resolutions, for example --bits "
                    "9:7..13:11");
  }
  for (const BitPair& bits : plan.bits) {
    if (has_mode(Mode::kBasis) && bits.fine > kMostBasisBits) {
      fail_option(
          "--bits", arguments.bits,
          fmt::format("mode basis has at most {} bits: stop there, or give --mode elp", kMostBasisBits));
    }
  }
  if (!arguments.period.empty() && !has_mode(Mode::kBasis))
    throw ToolError(ExitStatus::kUsage, "--period is of mode basis, which --mode does not name");
  for (const Mode mode : plan.modes)
    static_cast<void>(encode_options(arguments_of_row(arguments, mode, plan.bits[0])));
  return plan;
}

BenchedAnimation bench_animation(const BenchArguments& arguments, const BenchPlan& plan,
                                 const BenchInput& input) {
  return AnimationBench(arguments, plan, input).run();
}

}  // namespace tvg::cli
