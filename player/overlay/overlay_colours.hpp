#pragma once
#include "player/overlay/overlay_values.hpp"
#include "player/overlay/reference_frames.hpp"
#include "player/view/look.hpp"
#include "player/view/text_layer.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/source.hpp>
#include <tvg/types.hpp>

namespace tvg::player {

/// What `--overlay` asks for.
struct OverlaySpec {
  Overlay overlay = Overlay::kNone;
  std::optional<double> largest;               ///< value of the last colour; measured where absent
  std::shared_ptr<ReferenceFrames> reference;  ///< of kError, which needs one
  ShownMeasure measure{};                      ///< of kCost
};

/// Frames that are coded together.
struct OverlayGop {
  std::uint64_t first_frame = 0;
  std::uint64_t frame_count = 0;
  /// All of them, valid until the next GOP begins; empty, but for the skeleton, where they come one by one.
  MeasuredFrames frames;
};

/// A frame to be coloured.
struct OverlayFrame {
  std::uint64_t number = 0;
  const Mesh& mesh;
  std::span<const float> positions;     ///< [vertex][xyz]
  std::span<const std::uint8_t> flags;  ///< [vertex], of kImportance
  std::span<const float> joints{};      ///< [joint][xyz], of kCost; empty without a skeleton
  bool keeps_vertex_order = true;       ///< vertices are in the order of the sequence that was encoded
};

/// The colour map of an overlay.
cli::ColourMap colour_map_of(Overlay overlay);

/// What the last colour stands for: the value that a share of all vertices does not exceed, in the frame
/// where that is largest. Few vertices lie far above all others; the colours are for the rest. Any thread may
/// ask while one measures.
class OverlayScale {
 public:
  /// `largest`: the value, where it is not to be measured.
  OverlayScale(double share, std::optional<double> largest);

  /// Takes a frame's values into account, [vertex].
  void measure(std::span<const float> values);
  /// Measures no more: colours of frames to come mean what they mean now.
  void keep();

  double share() const { return share_; }
  /// 0 to 0 before anything was measured.
  cli::ValueRange range() const;

 private:
  const double share_;
  mutable std::mutex mutex_;
  cli::ValueRange range_;
  float peak_ = 0;  // the largest value of all
  bool empty_ = true;
  bool kept_;
  std::vector<float> scratch_;
};

/// An overlay at work: a value for each vertex of each frame, between 0 and 1, and a legend that says what
/// they mean. The same for every command. One thread colours frames, any may ask for the legend.
class OverlayColours {
 public:
  virtual ~OverlayColours() = default;

  /// A GOP begins; its frames follow, some or all, in ascending order.
  virtual void begin_gop(const OverlayGop&) {}
  /// Fills `values`, [vertex], and measures them for the scale, until it is kept. Throws ToolError where the
  /// frame cannot be coloured: kUsage, kInvalidInput, kIo.
  void colour(const OverlayFrame& frame, std::vector<float>& values);
  /// Values of frames to come mean what they mean now.
  void keep_scale() { scale_.keep(); }

  /// Title, colours and scale; the note is left to the command.
  virtual Legend legend() const = 0;
  /// "95 % of": what the scale's end is of the frames measured; for a note.
  std::string scale_note() const;

 protected:
  explicit OverlayColours(double share, std::optional<double> largest = {}) : scale_(share, largest) {}
  /// Fills `values` in the overlay's own units, and measures them where they are not those of the frame
  /// before.
  virtual void fill(const OverlayFrame& frame, std::vector<float>& values) = 0;
  OverlayScale& scale() { return scale_; }
  /// A legend of amounts, up to the scale's end.
  Legend bar_legend(const std::string& title) const;

 private:
  OverlayScale scale_;
};

/// Null for kNone.
std::unique_ptr<OverlayColours> make_overlay_colours(const OverlaySpec& spec);

}  // namespace tvg::player
