#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tvg/source.hpp>
#include <tvg/types.hpp>

// Values per vertex that colour a mesh, in their own units; scale_values() brings them to a colour map
// (tool/colour_map.hpp).
namespace tvg::cli {

/// 1 for important vertices and 0 for others, from Decoder::copy_flags(). `values`: [vertex], as many as
/// flags.
void importance_values(std::span<const std::uint8_t> flags, std::span<float> values);

/// What a legend calls cost_values(). A stream does not say which measure chose its important vertices.
inline constexpr const char* kCostTitle = "cost (curv, the default)";

/// The default measure's cost of each vertex over the frames of one GOP ([frame][vertex][xyz]), as the
/// encoder computes it without options; a stream may have been marked by another measure. [vertex].
std::vector<float> cost_values(const Mesh& mesh, std::span<const FramePositions> frames);

/// Distance of each vertex of a frame from where a reference has it, in the units of the positions.
/// `frame` and `reference`: [vertex][xyz] of one length; `values`: [vertex].
void error_values(std::span<const float> frame, std::span<const float> reference, std::span<float> values);

/// The units of positions as metadata have them; empty where they say none, or too much for a legend.
std::string short_units(const Metadata& metadata);

}  // namespace tvg::cli
