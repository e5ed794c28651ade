#pragma once
#include "tool/progress.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// Frames of a source that are in memory together.
struct FramesInMemory {
  Sequence sequence;                       ///< mesh, metadata and the frames held
  std::vector<std::vector<float>> joints;  ///< [frame held][joint][xyz]; empty where none were asked for
  std::vector<std::uint64_t> numbers;      ///< [frame held] counted from the source's first
  std::uint64_t total = 0;                 ///< frames of the source

  bool all() const { return numbers.size() == total; }
};

struct HoldSettings {
  std::uint64_t most_bytes = 0;
  bool joints = false;
  std::string names;  ///< of the inputs, for messages
};

/// Reads a source from its first frame: all frames where they take `most_bytes` together, else as many as do,
/// evenly spread, and at least one. The source then stands anywhere. Throws ToolError: what the source says,
/// kInvalidInput where it has no frame, kUsage where it can be read only once and does not fit.
FramesInMemory hold_frames(FrameSource& source, const HoldSettings& settings, ProgressBar& bar);

}  // namespace tvg::cli
