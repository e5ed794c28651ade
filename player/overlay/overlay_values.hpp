#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tvg/measure.hpp>
#include <tvg/source.hpp>
#include <tvg/types.hpp>

// Values per vertex that colour a mesh, in their own units; scale_values() brings them to a colour map
// (tool/colour_map.hpp).
namespace tvg::player {

/// 1 for important vertices and 0 for others, from Decoder::copy_flags(). `values`: [vertex], as many as
/// flags.
void importance_values(std::span<const std::uint8_t> flags, std::span<float> values);

/// The measure whose cost is shown. A stream does not say which one chose its important vertices.
struct ShownMeasure {
  Importance importance;
  std::string words = "curv, the default";      ///< what a legend calls it
  std::shared_ptr<const JointTracks> joints{};  ///< of a .tvg, frames by number; null where nobody named any
};

/// Frames that are measured together.
struct MeasuredFrames {
  std::span<const FramePositions> positions;     ///< [frame][vertex][xyz]
  const Skeleton* skeleton = nullptr;            ///< null where there is none
  std::span<const std::vector<float>> joints{};  ///< [frame][joint][xyz]; empty without a skeleton
};

/// The cost of each vertex over the frames of one GOP, at least one, as the encoder computes it: [vertex].
/// Throws ToolError (kUsage) where the criteria do not find what they need.
std::vector<float> cost_values(const Mesh& mesh, const MeasuredFrames& frames,
                               const Importance& importance = {});

/// Distance of each vertex of a frame from where a reference has it, in the units of the positions.
/// `frame` and `reference`: [vertex][xyz] of one length; `values`: [vertex].
void error_values(std::span<const float> frame, std::span<const float> reference, std::span<float> values);

/// The units of positions as metadata have them; empty where they say none, or too much for a legend.
std::string short_units(const Metadata& metadata);

}  // namespace tvg::player
