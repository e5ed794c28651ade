#include "player/render/whole_gops.hpp"

#include "tool/tool_error.hpp"

#include <fmt/format.h>
#include <utility>

namespace tvg::player {

namespace {

constexpr std::uint64_t kMostGopBytes = std::uint64_t{4} << 30;

class WholeGops final : public ShownFrames {
 public:
  WholeGops(std::unique_ptr<ShownFrames> gops, std::optional<FrameRange> wanted, OverlayColours& colours)
      : gops_(std::move(gops)), wanted_(wanted), colours_(colours) {}

  bool next(ShownFrame& frame) override {
    for (;;) {
      if (given_ == positions_.size() && !load_gop()) return false;
      const std::uint64_t number = first_ + given_;
      frame.joints = joints_[given_];
      frame.positions = positions_[given_++];
      if (wanted_ && number < wanted_->first) continue;
      if (wanted_ && number > wanted_->last) return false;
      frame.number = number;
      frame.gop = gop_;
      frame.mesh = mesh_;
      frame.surface = surface_;
      return true;
    }
  }

  bool rewind() override {
    if (!gops_->rewind()) return false;
    forget_gop();
    ahead_.reset();
    return true;
  }

  std::optional<std::uint64_t> total() const override { return gops_->total(); }
  bool keeps_vertex_order() const override { return gops_->keeps_vertex_order(); }
  const Skeleton& skeleton() const override { return gops_->skeleton(); }
  Metadata metadata() const override { return gops_->metadata(); }
  std::vector<double> times() const override { return gops_->times(); }
  std::string note() const override { return gops_->note(); }

 private:
  void forget_gop() {
    positions_.clear();
    joints_.clear();
    given_ = 0;
  }

  /// Reads a GOP and the frame after it, by which one knows that it has ended.
  bool load_gop() {
    forget_gop();
    if (!ahead_) {
      ahead_.emplace();
      if (!gops_->next(*ahead_)) return false;
    }
    if (!ahead_->mesh) return false;
    first_ = ahead_->number;
    gop_ = ahead_->gop;
    mesh_ = ahead_->mesh;
    surface_ = ahead_->surface;
    std::uint64_t bytes = 0;
    while (ahead_->mesh == mesh_ && ahead_->gop == gop_) {
      bytes += ahead_->positions.size() * (sizeof(float) + sizeof(double));
      if (bytes > kMostGopBytes) {
        throw cli::ToolError(
            cli::ExitStatus::kOther,
            fmt::format("--overlay cost: the GOP at frame {} needs more than {} GiB; encode with "
                        "a smaller --gop",
                        first_, kMostGopBytes >> 30));
      }
      positions_.push_back(std::move(ahead_->positions));
      joints_.push_back(std::move(ahead_->joints));
      *ahead_ = {};
      if (!gops_->next(*ahead_)) {
        *ahead_ = {};
        break;
      }
    }
    colours_.begin_gop({first_, positions_.size(), {positions_, &gops_->skeleton(), joints_}});
    return true;
  }

  std::unique_ptr<ShownFrames> gops_;
  std::optional<FrameRange> wanted_;
  OverlayColours& colours_;
  std::optional<ShownFrame> ahead_;         // without a mesh: the end is reached
  std::vector<FramePositions> positions_;   // of the GOP, [frame][vertex][xyz]
  std::vector<std::vector<float>> joints_;  // [frame][joint][xyz]
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const Surface> surface_;
  std::uint64_t first_ = 0;
  std::uint64_t gop_ = 0;
  std::size_t given_ = 0;
};

}  // namespace

std::unique_ptr<ShownFrames> with_whole_gops(std::unique_ptr<ShownFrames> gops,
                                             std::optional<FrameRange> wanted, OverlayColours& colours) {
  return std::make_unique<WholeGops>(std::move(gops), wanted, colours);
}

}  // namespace tvg::player
