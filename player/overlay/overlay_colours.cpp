#include "player/overlay/overlay_colours.hpp"

#include "player/overlay/overlay_values.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace tvg::cli {

namespace {

constexpr double kShareBelowError = 0.999;
constexpr double kShareBelowCost = 0.95;

class ImportanceColours final : public OverlayColours {
 public:
  ImportanceColours() : OverlayColours(1, 1.0) {}

  Legend legend() const override {
    Legend legend;
    legend.map = colour_map_of(Overlay::kImportance);
    legend.title = "importance";
    legend.flagged = "important (fine lattice)";
    legend.plain = "other (coarse lattice)";
    return legend;
  }

 private:
  void fill(const OverlayFrame& frame, std::vector<float>& values) override {
    values.resize(frame.flags.size());
    importance_values(frame.flags, values);
  }
};

/// The measure's cost over each GOP. It takes all frames of a GOP to know it: where they come one by one, the
/// frames show the cost of the GOP before until they have come once.
class CostColours final : public OverlayColours {
 public:
  explicit CostColours(std::optional<double> largest) : OverlayColours(kShareBelowCost, largest) {}

  Legend legend() const override { return bar_legend(kCostTitle); }

  void begin_gop(const OverlayGop& gop) override {
    frames_.clear();
    first_frame_ = gop.first_frame;
    frame_count_ = gop.frame_count;
    ahead_ = gop.frames;
    const auto known = costs_.find(first_frame_);
    known_ = known != costs_.end();
    if (known_) present_ = known->second;
  }

 private:
  void fill(const OverlayFrame& frame, std::vector<float>& values) override {
    if (!known_) learn(frame);
    values = *present_;
  }

  /// Of all frames where they are there; else of those that came, so that there is something to show.
  void learn(const OverlayFrame& frame) {
    if (!ahead_.empty()) return take_cost(frame.mesh, ahead_);
    const bool in_sequence = frames_.size() == frame.number - first_frame_;
    if (in_sequence) frames_.emplace_back(frame.positions.begin(), frame.positions.end());
    if (frames_.size() == frame_count_) return take_cost(frame.mesh, frames_);
    if (present_ != nullptr && present_->size() == frame.mesh.vertex_count) return;
    const FramePositions alone(frame.positions.begin(), frame.positions.end());
    take_cost(frame.mesh, {&alone, 1});
  }

  void take_cost(const Mesh& mesh, std::span<const FramePositions> frames) {
    present_ = std::make_shared<const std::vector<float>>(cost_values(mesh, frames));
    scale().measure(*present_);
    if (frames.size() == frame_count_) remember();
  }

  void remember() {
    constexpr std::size_t kMostBytes = std::size_t{128} << 20;
    known_ = true;
    frames_.clear();
    frames_.shrink_to_fit();
    costs_.insert_or_assign(first_frame_, present_);
    if (costs_.size() * present_->size() * sizeof(float) > kMostBytes) costs_.erase(costs_.begin());
  }

  std::uint64_t first_frame_ = 0;
  std::uint64_t frame_count_ = 0;
  bool known_ = false;  // the present GOP's cost is
  std::span<const FramePositions> ahead_;
  std::vector<FramePositions> frames_;  // of the present GOP, while its cost is not known
  std::map<std::uint64_t, std::shared_ptr<const std::vector<float>>> costs_;  // by a GOP's first frame
  std::shared_ptr<const std::vector<float>> present_;
};

/// Distance from the reference's frame of the same number.
class ErrorColours final : public OverlayColours {
 public:
  ErrorColours(std::shared_ptr<ReferenceFrames> reference, std::optional<double> largest)
      : OverlayColours(kShareBelowError, largest), reference_(std::move(reference)) {}

  Legend legend() const override { return bar_legend("distance to the reference"); }

 private:
  void fill(const OverlayFrame& frame, std::vector<float>& values) override {
    const ShownFrame& reference =
        reference_->same_mesh_at(frame.number, frame.mesh.vertex_count, frame.keeps_vertex_order);
    values.resize(frame.mesh.vertex_count);
    error_values(frame.positions, reference.positions, values);
    scale().measure(values);
  }

  std::shared_ptr<ReferenceFrames> reference_;
};

}  // namespace

ColourMap colour_map_of(Overlay overlay) {
  return overlay == Overlay::kImportance ? ColourMap::kFlags : ColourMap::kViridis;
}

OverlayScale::OverlayScale(double share, std::optional<double> largest)
    : share_(share), largest_(static_cast<float>(largest.value_or(0))), kept_(largest.has_value()) {}

void OverlayScale::measure(std::span<const float> values) {
  const float value = value_at_share(values, share_, scratch_);
  const std::lock_guard lock(mutex_);
  if (!kept_) largest_ = std::max(largest_, value);
}

void OverlayScale::keep() {
  const std::lock_guard lock(mutex_);
  kept_ = true;
}

float OverlayScale::largest() const {
  const std::lock_guard lock(mutex_);
  return largest_;
}

void OverlayColours::colour(const OverlayFrame& frame, std::vector<float>& values) {
  values.clear();
  fill(frame, values);
  scale_values(values, {0, scale_.largest()});
}

std::string OverlayColours::scale_note() const {
  return fmt::format("{:g} % of", 100 * scale_.share());
}

Legend OverlayColours::bar_legend(const std::string& title) const {
  Legend legend;
  legend.title = title;
  legend.largest = double{scale_.largest()};
  return legend;
}

std::unique_ptr<OverlayColours> make_overlay_colours(const OverlaySpec& spec) {
  switch (spec.overlay) {
    case Overlay::kNone:
      return nullptr;
    case Overlay::kImportance:
      return std::make_unique<ImportanceColours>();
    case Overlay::kCost:
      return std::make_unique<CostColours>(spec.largest);
    case Overlay::kError:
      return std::make_unique<ErrorColours>(spec.reference, spec.largest);
  }
  return nullptr;
}

}  // namespace tvg::cli
