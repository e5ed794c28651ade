#include "player/frames/shown_frames.hpp"
#include "tool/concealment.hpp"
#include "tool/frame_times.hpp"
#include "tool/option_values.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <utility>

#include <tvg/data.hpp>

namespace tvg::player {

namespace {

/// Frames of a .tvg. Where frames are lost and that is to be concealed, the last good one is given out again
/// under their numbers; the first good one where there was none before.
class StreamFrames final : public ShownFrames {
 public:
  explicit StreamFrames(ShownFramesSpec spec)
      : spec_(std::move(spec)),
        concealment_(spec_.inputs.front() == "-" ? "standard input" : spec_.inputs.front(), spec_.conceal) {
    open();
  }

  bool next(ShownFrame& frame) override {
    for (;;) {
      if (past_range(number_)) return false;
      if (loaded_ && number_ <= loaded_frame_.number) return give_out(frame);
      if (ended_) {
        if (number_ >= lost_end_ || !held_.mesh) return false;
        loaded_frame_ = held_;
        loaded_frame_.number = lost_end_ - 1;
        loaded_ = true;
        continue;
      }
      pull();
    }
  }

  bool rewind() override {
    if (!reader_->size()) return false;
    if (ended_ || lost_end_ > 0) concealment_.fall_silent();
    open();
    return true;
  }

  std::optional<std::uint64_t> total() const override { return total_; }
  bool keeps_vertex_order() const override { return reader_->decoder().mesh_info().keeps_vertex_order; }
  const Skeleton& skeleton() const override { return spec_.joints ? spec_.joints->skeleton : none_; }
  std::string note() const override {
    const std::string lod = reader_->lod_note(), textures = materials_.note();
    return lod.empty() || textures.empty() ? lod + textures : lod + "; " + textures;
  }
  Metadata metadata() const override { return reader_->decoder().metadata(); }
  std::vector<double> times() const override { return times_; }

 private:
  void open() {
    reader_ = std::make_unique<cli::StreamReader>(spec_.inputs.front());
    reader_->use_lod(spec_.lod);
    loaded_ = ended_ = false;
    held_ = {};
    mesh_.reset();
    surface_.reset();
    materials_ = {};
    number_ = lost_end_ = gop_ = 0;
    const auto index = reader_->read_index();
    if (index) {
      total_ = index->frame_count();
      if (spec_.frames) cli::check_frame_range(*spec_.frames, *total_, reader_->name());
    }
    while (!mesh_ && !ended_) pull();
    if (!mesh_)
      throw cli::ToolError(cli::ExitStatus::kInvalidInput, reader_->name() + ": the stream has no mesh");
    if (!spec_.frames) return;
    number_ = spec_.frames->first;
    if (number_ == 0 || !index) return;
    const StreamMap::Place* const gop = spec_.whole_gops ? index->gop_for(number_) : nullptr;
    reader_->seek(gop != nullptr ? gop->first_frame : number_);
  }

  bool past_range(std::uint64_t number) const {
    if (!spec_.frames || number <= spec_.frames->last) return false;
    return !spec_.whole_gops || !loaded_ || number > gop_end_;
  }

  bool give_out(ShownFrame& frame) {
    const bool lost = number_ < loaded_frame_.number;
    frame = lost && held_.mesh ? held_ : loaded_frame_;
    frame.number = number_++;
    if (!lost) held_ = loaded_frame_;
    return true;
  }

  /// Takes the decoder's next event.
  void pull() {
    const Decoder::Event event = reader_->next();
    const Decoder& decoder = reader_->decoder();
    switch (event) {
      case Decoder::Event::kMesh:
        take_mesh(decoder);
        break;
      case Decoder::Event::kData:
        take_data(decoder.data());
        break;
      case Decoder::Event::kGop:
        begin_gop(decoder);
        break;
      case Decoder::Event::kFrame:
        load(decoder);
        break;
      case Decoder::Event::kDamage:
        lose(decoder.damage());
        break;
      case Decoder::Event::kError:
        if (!spec_.conceal || !held_.mesh) throw cli::tool_error(reader_->name(), decoder.error());
        concealment_.tell(decoder.error());
        ended_ = true;
        break;
      case Decoder::Event::kEnd:
        ended_ = true;
        break;
      default:
        break;
    }
  }

  void take_mesh(const Decoder& decoder) {
    if (spec_.surfaces && !mesh_) materials_.make(folder_of(spec_.inputs));
    mesh_ = std::make_shared<const Mesh>(decoder.mesh());
    if (spec_.surfaces) surface_ = make_surface(*mesh_, decoder.properties(), materials_);
  }

  void take_data(const CodedData& coded) {
    const bool is_times = coded.name == "times";
    const bool is_wanted = is_times || (spec_.surfaces && !mesh_ && ShownMaterials::wants(coded.name));
    if (!is_wanted) return;
    Result<NamedData> data = unpack_data(coded);
    if (!data) return;
    if (is_times) {
      times_ = cli::times_from(data->bytes);
    } else {
      materials_.take(*std::move(data));
    }
  }

  void begin_gop(const Decoder& decoder) {
    const GopInfo& gop = decoder.gop();
    ++gop_;
    gop_end_ = gop.first_frame + gop.frame_count - 1;
    if (spec_.whole_gops && number_ > gop.first_frame && number_ <= gop_end_) number_ = gop.first_frame;
    if (!spec_.flags) return;
    std::vector<std::uint8_t> flags(mesh_->vertex_count);
    decoder.copy_flags(flags);
    flags_ = std::make_shared<const std::vector<std::uint8_t>>(std::move(flags));
  }

  void load(const Decoder& decoder) {
    loaded_ = true;
    loaded_frame_.number = decoder.frame_number();
    loaded_frame_.gop = gop_;
    loaded_frame_.mesh = mesh_;
    loaded_frame_.surface = surface_;
    loaded_frame_.positions.resize(3 * std::size_t{mesh_->vertex_count});
    decoder.copy_positions(loaded_frame_.positions.data());
    loaded_frame_.colours.clear();
    if (surface_ != nullptr && surface_->frame_colours) {
      const std::span<const float> colours = decoder.animated_values(surface_->frame_colours->attribute);
      loaded_frame_.colours.assign(colours.begin(), colours.end());
    }
    loaded_frame_.flags = flags_;
    if (spec_.joints) loaded_frame_.joints = joints_at(*spec_.joints, loaded_frame_.number, reader_->name());
  }

  void lose(const Damage& damage) {
    // Not from the first frame wanted on, but from the one that comes next: a GOP may be wanted whole.
    std::optional<FrameRange> wanted = spec_.frames;
    if (wanted && number_ > wanted->last) return;
    if (wanted) wanted->first = number_;
    const std::optional<cli::HeldFrames> lost = concealment_.hold(damage, wanted);
    if (lost) lost_end_ = std::max(lost_end_, lost->end);
  }

  ShownFramesSpec spec_;
  const Skeleton none_;
  cli::Concealment concealment_;
  std::unique_ptr<cli::StreamReader> reader_;
  std::shared_ptr<const Mesh> mesh_;
  ShownMaterials materials_;
  std::vector<double> times_;
  std::shared_ptr<const Surface> surface_;
  std::optional<std::uint64_t> total_;
  std::shared_ptr<const std::vector<std::uint8_t>> flags_;  // of the present GOP
  ShownFrame loaded_frame_;                                 // the newest that the decoder gave
  ShownFrame held_;                                         // the last good one given out
  bool loaded_ = false;
  bool ended_ = false;
  std::uint64_t number_ = 0;    // of the next frame to give out
  std::uint64_t lost_end_ = 0;  // one past the last frame lost
  std::uint64_t gop_ = 0;
  std::uint64_t gop_end_ = 0;
};

}  // namespace

std::unique_ptr<ShownFrames> open_stream_frames(const ShownFramesSpec& spec) {
  return std::make_unique<StreamFrames>(spec);
}

}  // namespace tvg::player
