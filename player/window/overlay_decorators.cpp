#include "player/window/overlay_decorators.hpp"

#include "player/render/shown_frames.hpp"
#include "player/view/overlay.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

namespace tvg::cli {

namespace {

/// Below this share of vertices lies the value that the last colour stands for.
constexpr double kShareInScale = 0.999;

class ImportanceDecorator final : public OverlayDecorator {
 public:
  Legend legend() const override {
    Legend legend;
    legend.map = ColourMap::kFlags;
    legend.title = "importance";
    legend.plain = "coarse lattice";
    legend.flagged = "fine lattice";
    return legend;
  }
  void on_gop(const Mesh&, const PlayerGop&) override {}
  void on_frame(PlayerFrame& frame) override {
    frame.values.resize(frame.positions.size() / 3);
    importance_values(frame.gop->flags, frame.values);
  }
};

/// A scale that only grows, so that colours do not flicker: 0 to the largest value met.
class GrowingScale {
 public:
  float take(std::span<const float> values) {
    const float value = value_at_share(values, kShareInScale, scratch_);
    const std::lock_guard lock(mutex_);
    largest_ = std::max(largest_, value);
    return largest_;
  }
  float largest() const {
    const std::lock_guard lock(mutex_);
    return largest_;
  }

 private:
  mutable std::mutex mutex_;
  float largest_ = 0;
  std::vector<float> scratch_;
};

/// The measure's cost over each GOP. It takes all frames of a GOP to know it: until they were decoded once,
/// the frames show the cost of the GOP before.
class CostDecorator final : public OverlayDecorator {
 public:
  Legend legend() const override {
    Legend legend;
    legend.title = kCostTitle;
    legend.note = "of the GOP before until a GOP is whole";
    legend.largest = scale_.largest();
    return legend;
  }

  void on_gop(const Mesh&, const PlayerGop& gop) override {
    frames_.clear();
    first_frame_ = gop.info.first_frame;
    if (const auto known = costs_.find(first_frame_); known != costs_.end()) present_ = known->second;
  }

  void on_frame(PlayerFrame& frame) override {
    const std::size_t vertices = frame.positions.size() / 3;
    if (costs_.count(first_frame_) == 0) {
      if (frames_.size() == frame.number - first_frame_) frames_.push_back(frame.positions);
      const bool whole = frames_.size() == frame.gop->info.frame_count;
      if (whole || present_ == nullptr || present_->size() != vertices) {
        present_ = std::make_shared<const std::vector<float>>(cost_values(*frame.mesh, frames_));
        scale_.take(*present_);
      }
      if (whole) remember();
    }
    frame.values = *present_;
    scale_values(frame.values, {0, scale_.largest()});
  }

 private:
  void remember() {
    constexpr std::size_t kMostBytes = std::size_t{128} << 20;
    frames_.clear();
    frames_.shrink_to_fit();
    costs_.insert_or_assign(first_frame_, present_);
    if (costs_.size() * present_->size() * sizeof(float) > kMostBytes) costs_.erase(costs_.begin());
  }

  std::uint64_t first_frame_ = 0;
  std::vector<FramePositions> frames_;  ///< of the present GOP, while its cost is not known
  std::map<std::uint64_t, std::shared_ptr<const std::vector<float>>> costs_;  ///< by a GOP's first frame
  std::shared_ptr<const std::vector<float>> present_;
  GrowingScale scale_;
};

/// Distance from the reference's frame of the same number.
class ErrorDecorator final : public OverlayDecorator {
 public:
  ErrorDecorator(std::vector<std::string> inputs, SourceOpener open_source)
      : spec_{std::move(inputs), {}, false, false, false, std::move(open_source)},
        frames_(open_frames(spec_)) {}

  Legend legend() const override {
    const std::lock_guard lock(mutex_);
    Legend legend;
    legend.title = "error";
    legend.note = problem_.empty() ? "distance from the reference" : problem_;
    legend.largest = scale_.largest();
    return legend;
  }

  void on_gop(const Mesh&, const PlayerGop&) override {}

  void on_frame(PlayerFrame& frame) override {
    frame.values.clear();
    if (!find(frame.number)) return;
    if (reference_.positions.size() != frame.positions.size()) {
      return complain("the reference has another number of vertices");
    }
    frame.values.resize(frame.positions.size() / 3);
    error_values(frame.positions, reference_.positions, frame.values);
    scale_values(frame.values, {0, scale_.take(frame.values)});
  }

 private:
  /// Reads the reference on to the frame of this number, from its start where that lies behind.
  bool find(std::uint64_t number) {
    try {
      if (has_frame_ && reference_.number > number) {
        if (!frames_->rewind()) frames_ = open_frames(spec_);
        has_frame_ = false;
      }
      while (!has_frame_ || reference_.number < number) {
        has_frame_ = frames_->next(reference_);
        if (!has_frame_) {
          complain("the reference has fewer frames");
          frames_ = open_frames(spec_);
          return false;
        }
      }
      return true;
    } catch (const ToolError& error) {
      complain(error.what());
      return false;
    }
  }

  void complain(const std::string& problem) {
    const std::lock_guard lock(mutex_);
    problem_ = problem;
  }

  ShownFramesSpec spec_;
  std::unique_ptr<ShownFrames> frames_;
  ShownFrame reference_;
  bool has_frame_ = false;
  GrowingScale scale_;
  mutable std::mutex mutex_;
  std::string problem_;
};

}  // namespace

std::shared_ptr<OverlayDecorator> make_overlay_decorator(Overlay overlay,
                                                         const std::vector<std::string>& reference,
                                                         SourceOpener open_source) {
  switch (overlay) {
    case Overlay::kNone:
      return nullptr;
    case Overlay::kImportance:
      return std::make_shared<ImportanceDecorator>();
    case Overlay::kCost:
      return std::make_shared<CostDecorator>();
    case Overlay::kError:
      return std::make_shared<ErrorDecorator>(reference, std::move(open_source));
  }
  return nullptr;
}

}  // namespace tvg::cli
