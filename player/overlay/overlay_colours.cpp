#include "player/overlay/overlay_colours.hpp"

#include "player/overlay/overlay_values.hpp"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace tvg::player {

namespace {

constexpr double kShareBelowError = 0.999;
constexpr double kShareBelowCost = 0.95;

/// The marks that the stream carries, GOP by GOP.
class ImportanceColours final : public OverlayColours {
 public:
  ImportanceColours() : OverlayColours(1, 1.0) {}

  Legend legend() const override {
    Legend legend;
    legend.map = colour_map_of(Overlay::kImportance);
    legend.title = "importance";
    legend.flagged = "important (fine lattice)";
    legend.plain = "other (coarse lattice)";
    const std::uint64_t marked = marked_, vertices = vertices_;
    if (vertices == 0) return legend;
    if (marked == vertices) {
      legend.flagged = "every vertex: there is one lattice";
    } else {
      legend.flagged +=
          fmt::format(", {:.3g} %", 100 * static_cast<double>(marked) / static_cast<double>(vertices));
    }
    return legend;
  }

 private:
  void fill(const OverlayFrame& frame, std::vector<float>& values) override {
    vertices_ += frame.flags.size();
    marked_ += static_cast<std::uint64_t>(std::ranges::count(frame.flags, 1));
    values.resize(frame.flags.size());
    importance_values(frame.flags, values);
  }

  // Of all frames so far. Whoever asks for the legend may do so from another thread.
  std::atomic<std::uint64_t> vertices_ = 0, marked_ = 0;
};

/// The measure's cost over each GOP. It takes all frames of a GOP to know it: where they come one by one, the
/// frames show the cost of the GOP before until they have come once.
class CostColours final : public OverlayColours {
 public:
  CostColours(ShownMeasure measure, std::optional<double> largest)
      : OverlayColours(kShareBelowCost, largest), measure_(std::move(measure)) {}

  Legend legend() const override { return bar_legend(fmt::format("cost ({})", measure_.words)); }

  void begin_gop(const OverlayGop& gop) override {
    gop_ = gop;
    frames_.clear();
    joints_.clear();
    const auto known = costs_.find(gop.first_frame);
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
    if (!gop_.frames.positions.empty()) return take_cost(frame.mesh, gop_.frames);
    const bool in_sequence = frames_.size() == frame.number - gop_.first_frame;
    if (in_sequence) {
      frames_.emplace_back(frame.positions.begin(), frame.positions.end());
      joints_.emplace_back(frame.joints.begin(), frame.joints.end());
    }
    if (frames_.size() == gop_.frame_count) {
      return take_cost(frame.mesh, {frames_, gop_.frames.skeleton, joints_});
    }
    if (present_ != nullptr && present_->size() == frame.mesh.vertex_count) return;
    const FramePositions alone(frame.positions.begin(), frame.positions.end());
    const std::vector<float> joints(frame.joints.begin(), frame.joints.end());
    take_cost(frame.mesh, {{&alone, 1}, gop_.frames.skeleton, {&joints, 1}});
  }

  void take_cost(const Mesh& mesh, const MeasuredFrames& frames) {
    present_ = std::make_shared<const std::vector<float>>(cost_values(mesh, frames, measure_.importance));
    scale().measure(*present_);
    if (frames.positions.size() == gop_.frame_count) remember();
  }

  void remember() {
    constexpr std::size_t kMostBytes = std::size_t{128} << 20;
    known_ = true;
    frames_ = {};
    joints_ = {};
    costs_.insert_or_assign(gop_.first_frame, present_);
    if (costs_.size() * present_->size() * sizeof(float) > kMostBytes) costs_.erase(costs_.begin());
  }

  const ShownMeasure measure_;
  OverlayGop gop_;
  bool known_ = false;                      // the present GOP's cost is
  std::vector<FramePositions> frames_;      // of the present GOP, while its cost is not known
  std::vector<std::vector<float>> joints_;  // the same
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

cli::ColourMap colour_map_of(Overlay overlay) {
  return overlay == Overlay::kImportance ? cli::ColourMap::kFlags : cli::ColourMap::kViridis;
}

OverlayScale::OverlayScale(double share, std::optional<double> largest)
    : share_(share), range_{0, static_cast<float>(largest.value_or(0))}, kept_(largest.has_value()) {}

void OverlayScale::measure(std::span<const float> values) {
  if (values.empty()) return;
  const float value = cli::value_at_share(values, share_, scratch_);
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
  const std::lock_guard lock(mutex_);
  if (kept_) return;
  range_.smallest = std::min(range_.smallest, *smallest);
  range_.largest = empty_ ? value : std::max(range_.largest, value);
  peak_ = empty_ ? *largest : std::max(peak_, *largest);
  empty_ = false;
}

void OverlayScale::keep() {
  const std::lock_guard lock(mutex_);
  kept_ = true;
}

cli::ValueRange OverlayScale::range() const {
  const std::lock_guard lock(mutex_);
  // Where hardly a vertex has a value, those few are what there is to see.
  const bool flat = !empty_ && !(range_.largest > range_.smallest);
  return {range_.smallest, flat ? peak_ : range_.largest};
}

void OverlayColours::colour(const OverlayFrame& frame, std::vector<float>& values) {
  values.clear();
  fill(frame, values);
  cli::scale_values(values, scale_.range());
}

std::string OverlayColours::scale_note() const {
  return fmt::format("{:g} % of", 100 * scale_.share());
}

Legend OverlayColours::bar_legend(const std::string& title) const {
  Legend legend;
  legend.title = title;
  const cli::ValueRange range = scale_.range();
  legend.smallest = double{range.smallest};
  legend.largest = double{range.largest};
  return legend;
}

std::unique_ptr<OverlayColours> make_overlay_colours(const OverlaySpec& spec) {
  switch (spec.overlay) {
    case Overlay::kNone:
      return nullptr;
    case Overlay::kImportance:
      return std::make_unique<ImportanceColours>();
    case Overlay::kCost:
      return std::make_unique<CostColours>(spec.measure, spec.largest);
    case Overlay::kError:
      return std::make_unique<ErrorColours>(spec.reference, spec.largest);
  }
  return nullptr;
}

}  // namespace tvg::player
