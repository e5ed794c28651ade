#pragma once
#include "player/overlay/overlay_values.hpp"
#include "player/view/look.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace tvg::player {

/// What `tvg play` was asked for.
struct PlayOptions : Look {
  std::string location;  ///< a path, "-" or a URL; empty: a window that waits for one
  ShownMeasure measure;  ///< of Overlay::kCost
  std::optional<double> rate;
  double speed = 1;
  bool looping = true;
  bool paused = false;
  std::uint64_t start = 0;                                ///< first frame to show
  std::uint32_t lod = 0;                                  ///< which coarser mesh is played; 0 the whole
  std::uint64_t memory_bytes = std::uint64_t{512} << 20;  ///< of decoded frames
  std::string screenshot;         ///< saves the window as it shows the first frame, and ends
  std::optional<double> seconds;  ///< ends after so long
  std::string report;             ///< where figures go at the end, as JSON
};

}  // namespace tvg::player
