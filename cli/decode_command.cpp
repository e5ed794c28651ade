#include "cli/commands.hpp"
#include "decoder/exporters/frame_sink.hpp"
#include "tool/concealment.hpp"
#include "tool/decode_ahead.hpp"
#include "tool/input_files.hpp"
#include "tool/option_values.hpp"
#include "tool/overwriting.hpp"
#include "tool/progress.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <thread>
#include <utility>

#include <tvg/data.hpp>
#include <tvg/levels.hpp>

namespace tvg::cli {

namespace {

struct DecodeArguments {
  std::string input;
  std::string output;
  std::string frames;
  unsigned threads = 0;
  std::uint32_t components = kMaxComponents;
  std::uint32_t lod = 0;
  bool conceal = false;
  bool quiet = false;
  std::string gltf_positions = "float";
  std::string gltf_keys = "linear";
};

SinkOptions sink_options(const DecodeArguments& arguments) {
  SinkOptions options;
  options.gltf_quantized = arguments.gltf_positions == "quantized";
  options.gltf_steps = arguments.gltf_keys == "step";
  return options;
}

/// Of frames that were decoded and not written yet. GOPs larger than that are decoded one at a time.
constexpr std::uint64_t kMostBytesAhead = std::uint64_t{1} << 30;

/// Writes the wanted frames of a stream to a sink, and keeps count of what is missing.
class DecodeJob {
 public:
  explicit DecodeJob(const DecodeArguments& arguments)
      : arguments_(arguments),
        reader_(arguments.input),
        sink_(open_sink(arguments.output, sink_options(arguments))),
        concealment_(reader_.name(), arguments.conceal),
        bar_("decoding", arguments.quiet),
        threads_(arguments.threads != 0 ? arguments.threads
                                        : std::max(1u, std::thread::hardware_concurrency())) {}

  void run() {
    reader_.decoder().use_components(arguments_.components);
    reader_.use_lod(arguments_.lod);
    index_ = reader_.read_index();
    if (index_) total_ = index_->frame_count();
    if (!arguments_.frames.empty()) {
      wanted_ = parse_frame_range(arguments_.frames);
      if (total_) check_frame_range(*wanted_, *total_, reader_.name());
    }
    // A coarser mesh is little work, and is to be read with as few bytes as can be.
    if (threads_ > 1 && index_ && *total_ > 0 && arguments_.lod == 0) run_ahead();
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
      case Decoder::Event::kData:
        add_data(decoder.data());
        break;
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

  /// What comes with the first mesh or before it, and times; what a later part of joined streams has under
  /// the same names is of that part alone.
  void add_data(const CodedData& coded) {
    if (begun_ && coded.name != "times") return;
    Result<NamedData> data = unpack_data(coded);
    if (!data) {
      notes_.push_back(fmt::format("the data \"{}\" are left out: {}", coded.name, data.error().message));
      return;
    }
    constexpr std::uint64_t kTimeBytes = 8;
    if (data->name == "times" && wanted_) {
      const std::uint64_t frames = data->bytes.size() / kTimeBytes;
      const auto first = static_cast<std::ptrdiff_t>(kTimeBytes * std::min(wanted_->first, frames));
      const auto end = static_cast<std::ptrdiff_t>(
          kTimeBytes * (frames == 0 ? 0 : std::min(wanted_->last, frames - 1) + 1));
      data->bytes = {data->bytes.begin() + std::min(first, end), data->bytes.begin() + end};
    }
    sink_->add_data(*data);
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
    sink_->begin_mesh(decoder.mesh(), decoder.properties(), decoder.metadata(), frames);
    if (wanted_ && index_ && wanted_->first > 0) reader_.seek(wanted_->first);
  }

  bool is_wanted(std::uint64_t frame) const {
    return !wanted_ || (frame >= wanted_->first && frame <= wanted_->last);
  }

  void write_frame() {
    const Decoder& decoder = reader_.decoder();
    if (is_wanted(decoder.frame_number())) {
      decoder.copy_positions(frame_buffer().data());
      values_ = KeptValues(decoder);
    }
    take_frame(decoder.frame_number());
  }

  /// Where the positions of the next frame go. A mesh that the sink has not heard of gets known to it.
  std::vector<float>& frame_buffer() {
    if (!std::exchange(pending_mesh_, false)) return positions_;
    const Decoder& decoder = reader_.decoder();
    positions_.resize(3 * std::size_t{decoder.mesh().vertex_count});
    sink_->begin_mesh(decoder.mesh(), decoder.properties(), decoder.metadata(), output_frames_);
    return positions_;
  }

  /// A frame is there; if it is wanted, positions_ holds it.
  void take_frame(std::uint64_t frame) {
    next_frame_ = frame + 1;
    if (is_wanted(frame)) {
      for (; held_ > 0; --held_)
        sink_->write_frame(positions_, values_.spans());  // lost before any good frame: the first stands in
      sink_->write_frame(positions_, values_.spans());
      ++written_;
      bar_.update(written_, output_frames_);
    }
    if (wanted_ && frame >= wanted_->last) done_ = true;
  }

  /// Where the mesh lies that begin_mesh() has told the sink of.
  static std::uint64_t first_mesh_offset(const StreamMap& map) {
    for (const StreamMap::Place& place : map.places()) {
      if (place.entry.kind == IndexEntry::Kind::kMesh) return place.entry.offset;
    }
    return 0;
  }

  bool has_animated() const {
    const std::vector<Attribute>& attributes = reader_.decoder().properties().attributes;
    return std::any_of(attributes.begin(), attributes.end(),
                       [](const Attribute& attribute) { return attribute.animated; });
  }

  /// Decodes GOPs several at a time, as long as nothing is wrong with them. What is, is then read in order.
  void run_ahead() {
    while (!begun_ && !done_) handle(reader_.next());
    if (done_) return;
    const StreamLimits& limits = reader_.decoder().head().limits;
    const std::uint64_t bytes = limits.frames_per_gop * (std::uint64_t{limits.vertices} * 3 * sizeof(float) +
                                                         (has_animated() ? limits.property_bytes : 0));
    if (bytes > kMostBytesAhead / (threads_ + 1)) return;
    std::uint64_t told_mesh = first_mesh_offset(*index_);
    DecodeAhead ahead(arguments_.input, *index_, wanted_.value_or(FrameRange{0, *total_ - 1}), threads_,
                      arguments_.components);
    while (std::optional<DecodedGop> gop = ahead.next()) {
      if (!gop->whole) {
        reader_.seek(gop->first_frame);
        return;
      }
      if (std::exchange(told_mesh, gop->mesh_offset) != gop->mesh_offset)
        sink_->begin_mesh(*gop->mesh, *gop->properties, reader_.decoder().metadata(), output_frames_);
      for (std::size_t i = 0; i < gop->frames.size() && !done_; ++i) {
        positions_.swap(gop->frames[i]);
        std::swap(values_, gop->values[i]);
        take_frame(gop->first_frame + i);
      }
    }
    done_ = true;
  }

  void conceal_damage(const Damage& damage) {
    const std::optional<HeldFrames> lost = concealment_.hold(damage, wanted_, what_is_left());
    if (!lost) return;
    lost_ += lost->count();
    next_frame_ = damage.first_frame + damage.frame_count;
    if (written_ == 0) {
      held_ += lost->count();
    } else {
      for (std::uint64_t frame = lost->first; frame < lost->end; ++frame)
        sink_->write_frame(positions_, values_.spans());
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
    for (const std::string& note : notes_) fmt::print(stderr, "note: {}\n", note);
    for (const std::string& note : sink_->notes()) fmt::print(stderr, "note: {}\n", note);
    fmt::print(stderr, "{}: {} frames\n", written_files(*sink_, arguments_.output), written_ + lost_);
    if (arguments_.lod > 0) fmt::print(stderr, "note: {}\n", reader_.lod_note());
  }

  const DecodeArguments& arguments_;
  StreamReader reader_;
  std::unique_ptr<FrameSink> sink_;
  Concealment concealment_;
  ProgressBar bar_;
  unsigned threads_;
  std::optional<StreamMap> index_;
  std::optional<std::uint64_t> total_;          ///< frames of the stream
  std::optional<std::uint64_t> output_frames_;  ///< frames that are to be written
  std::optional<FrameRange> wanted_;
  std::vector<std::string> notes_;
  std::vector<float> positions_;  ///< the last good frame, [vertex][xyz]
  KeptValues values_;             ///< of it
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
  command.add_option(
      "-o,--output", arguments->output,
      "a cache (back.pc2, back.mdd, back.npy; the mesh goes beside it as OBJ; - for PC2 on standard "
      "output), a scene that any engine plays (back.glb, back.gltf), or a sequence of mesh files "
      "(back_%04d.obj, .ply, .off, .stl); default: NAME_decoded.pc2 beside NAME.tvg");
  command.add_option("--frames", arguments->frames, "decode frames A-B only, counted from 0");
  command
      .add_option("--components", arguments->components,
                  "of planes that GOPs in mode basis share, use only so many, rounded up to a multiple of 4: "
                  "coarser, and sooner done (default: all)")
      ->check(CLI::Range(1u, kMaxComponents));
  command
      .add_option(
          "--lod", arguments->lod,
          "the coarser mesh of this number that the stream has, 1 the first; in mode basis fewer bytes "
          "are read for it (default: 0, the whole mesh)")
      ->check(CLI::Range(0u, kMaxCoarseMeshes));
  command.add_flag("--conceal", arguments->conceal,
                   "where frames are damaged, hold the last good one and go on");
  command
      .add_option("--gltf-positions", arguments->gltf_positions,
                  "of .glb and .gltf: float, or quantized: 16 bits over all frames (KHR_mesh_quantization)")
      ->check(CLI::IsMember({"float", "quantized"}))
      ->capture_default_str();
  command
      .add_option("--gltf-keys", arguments->gltf_keys,
                  "of .glb and .gltf: linear, where frames pass over into the next, or step")
      ->check(CLI::IsMember({"linear", "step"}))
      ->capture_default_str();
  command.add_option("--threads", arguments->threads, "GOPs decoded at a time (default: one per processor)")
      ->check(CLI::Range(1, 256));
  command.add_flag("-q,--quiet", arguments->quiet, "print errors only");
  command.callback([arguments] {
    if (arguments->output.empty()) arguments->output = default_output(arguments->input, "_decoded.pc2");
    InputFiles inputs;
    inputs.add(arguments->input);
    for (const std::string& output : sink_outputs(arguments->output, {})) inputs.check_output(output);
    DecodeJob(*arguments).run();
  });
}

}  // namespace tvg::cli
