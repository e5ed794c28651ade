#include "cli/commands.hpp"
#include "decoder/exporters/frame_sink.hpp"
#include "tool/concealment.hpp"
#include "tool/input_files.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace tvg::cli {

namespace {

struct DecodeArguments {
  std::string input;
  std::string output;
  std::string frames;
  bool conceal = false;
  bool quiet = false;
};

/// Writes the wanted frames of a stream to a sink, and keeps count of what is missing.
class DecodeJob {
 public:
  explicit DecodeJob(const DecodeArguments& arguments)
      : arguments_(arguments),
        reader_(arguments.input),
        sink_(open_sink(arguments.output, {})),
        concealment_(reader_.name(), arguments.conceal),
        bar_("decoding", arguments.quiet) {}

  void run() {
    index_ = reader_.read_index();
    if (index_) {
      total_ = 0;
      for (const IndexEntry& entry : *index_) *total_ += entry.frame_count;
    }
    if (!arguments_.frames.empty()) {
      wanted_ = parse_frame_range(arguments_.frames);
      if (total_) check_frame_range(*wanted_, *total_, reader_.name());
    }
    while (!done_) handle(reader_.next());
    if (wanted_ && written_ + lost_ < wanted_->last - wanted_->first + 1) {
      throw ToolError(ExitStatus::kUsage,
                      fmt::format("--frames {}: {} ends at frame {}", arguments_.frames, reader_.name(),
                                  next_frame_ == 0 ? 0 : next_frame_ - 1));
    }
    sink_->finish();
    report();
  }

 private:
  void handle(Decoder::Event event) {
    const Decoder& decoder = reader_.decoder();
    switch (event) {
      case Decoder::Event::kMesh:
        begin_mesh();
        break;
      case Decoder::Event::kFrame:
        write_frame();
        break;
      case Decoder::Event::kDamage:
        conceal_damage(decoder.damage());
        break;
      case Decoder::Event::kEnd:
        done_ = true;
        break;
      case Decoder::Event::kError:
        fail_or_stop(decoder.error());
        break;
      default:
        break;
    }
  }

  void begin_mesh() {
    const Decoder& decoder = reader_.decoder();
    if (begun_) {
      pending_mesh_ = true;  // the sink hears of it when a wanted frame comes
      return;
    }
    begun_ = true;
    std::optional<std::uint64_t> frames = total_;
    if (wanted_) frames = wanted_->last - wanted_->first + 1;
    output_frames_ = frames;
    positions_.resize(3 * std::size_t{decoder.mesh().vertex_count});
    sink_->begin_mesh(decoder.mesh(), decoder.metadata(), frames);
    if (wanted_ && index_ && wanted_->first > 0) reader_.seek(wanted_->first);
  }

  bool is_wanted(std::uint64_t frame) const {
    return !wanted_ || (frame >= wanted_->first && frame <= wanted_->last);
  }

  void write_frame() {
    const Decoder& decoder = reader_.decoder();
    const std::uint64_t frame = decoder.frame_number();
    next_frame_ = frame + 1;
    if (is_wanted(frame)) {
      if (pending_mesh_) {
        pending_mesh_ = false;
        positions_.resize(3 * std::size_t{decoder.mesh().vertex_count});
        sink_->begin_mesh(decoder.mesh(), decoder.metadata(), output_frames_);
      }
      decoder.copy_positions(positions_.data());
      for (; held_ > 0; --held_)
        sink_->write_frame(positions_);  // lost before any good frame: the first stands in
      sink_->write_frame(positions_);
      ++written_;
      bar_.update(written_, output_frames_);
    }
    if (wanted_ && frame >= wanted_->last) done_ = true;
  }

  void conceal_damage(const Damage& damage) {
    const std::optional<HeldFrames> lost = concealment_.hold(damage, wanted_, what_is_left());
    if (!lost) return;
    lost_ += lost->count();
    next_frame_ = damage.first_frame + damage.frame_count;
    if (written_ == 0) {
      held_ += lost->count();
    } else {
      for (std::uint64_t frame = lost->first; frame < lost->end; ++frame) sink_->write_frame(positions_);
    }
    if (wanted_ && next_frame_ > wanted_->last) done_ = true;
  }

  /// What a user finds after a failure. Of a sequence, files before the failure are whole and stay.
  std::string what_is_left() const {
    if (arguments_.output == "-") return "the output is not complete";
    const std::vector<std::string>& files = sink_->files();
    return files.empty() ? "nothing was written" : fmt::format("{} is the last file written", files.back());
  }

  void fail_or_stop(const Error& error) {
    if (!arguments_.conceal || written_ == 0) throw tool_error(reader_.name(), error);
    concealment_.tell(error);
    done_ = true;
  }

  void report() const {
    if (arguments_.quiet) return;
    for (const std::string& note : sink_->notes()) fmt::print(stderr, "note: {}\n", note);
    const std::vector<std::string>& files = sink_->files();
    const std::string names = files.empty()       ? arguments_.output
                              : files.size() <= 2 ? fmt::format("{}", fmt::join(files, ", "))
                                                  : files.front() + " to " + files.back();
    fmt::print(stderr, "{}: {} frames\n", names, written_ + lost_);
  }

  const DecodeArguments& arguments_;
  StreamReader reader_;
  std::unique_ptr<FrameSink> sink_;
  Concealment concealment_;
  ProgressBar bar_;
  std::optional<std::vector<IndexEntry>> index_;
  std::optional<std::uint64_t> total_;          ///< frames of the stream
  std::optional<std::uint64_t> output_frames_;  ///< frames that are to be written
  std::optional<FrameRange> wanted_;
  std::vector<float> positions_;  ///< the last good frame, [vertex][xyz]
  bool begun_ = false;
  bool pending_mesh_ = false;
  bool done_ = false;
  std::uint64_t next_frame_ = 0;
  std::uint64_t written_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t held_ = 0;
};

}  // namespace

void add_decode_command(CLI::App& tool) {
  auto arguments = std::make_shared<DecodeArguments>();
  CLI::App& command = *tool.add_subcommand(
      "decode",
      "Restore the frames of a .tvg. Positions are float32: with more than 20 bits, their rounding can put a "
      "coordinate off by more than half a step.");
  command.add_option("input", arguments->input, "the stream; - for standard input")->required();
  command
      .add_option(
          "-o,--output", arguments->output,
          "a cache (back.pc2, back.mdd; the mesh goes beside it as OBJ; - for PC2 on standard output) or a "
          "sequence of mesh files (back_%04d.obj, .ply, .off, .stl)")
      ->required();
  command.add_option("--frames", arguments->frames, "decode frames A-B only, counted from 0");
  command.add_flag("--conceal", arguments->conceal,
                   "where frames are damaged, hold the last good one and go on");
  command.add_flag("-q,--quiet", arguments->quiet, "print errors only");
  command.callback([arguments] {
    InputFiles inputs;
    inputs.add(arguments->input);
    for (const std::string& output : sink_outputs(arguments->output, {})) inputs.check_output(output);
    DecodeJob(*arguments).run();
  });
}

}  // namespace tvg::cli
