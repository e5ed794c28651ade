#pragma once
#include "player/render/render_options.hpp"

#include <cstdint>
#include <vector>

namespace tvg::player {

/// Columns and rows that suit so many frames, at most 12 of them, in a picture of this size: cells a little
/// wider than high, few left empty.
SheetShape sheet_shape(std::uint64_t frames, int width, int height);

/// `count` positions spread evenly over `frames`, the first and the last among them; all where there are no
/// more. `frames` and `count`: at least 1.
std::vector<std::uint64_t> spread_evenly(std::uint64_t frames, std::uint64_t count);

}  // namespace tvg::player
