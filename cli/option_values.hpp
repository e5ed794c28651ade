#pragma once
#include "encoder/importers/frame_range.hpp"

#include <cstdint>
#include <string>

// Values of options as users type them. Every function throws ToolError (kUsage) that shows what would be
// right.
namespace tvg::cli {

/// "A-B": frames A to B, both included, or "A" for one frame.
FrameRange parse_frame_range(const std::string& text);

struct BitPair {
  int fine = 0;
  int coarse = 0;
};
/// "13:11": B2 and B1; "11": both the same.
BitPair parse_bits(const std::string& text);

struct StepPair {
  double fine = 0;
  int shift = 0;  ///< the coarse step is 2^shift times the fine one
};
/// "0.01:0.04": the steps of important and other vertices, a power of two apart; "0.01": both the same.
StepPair parse_step(const std::string& text);

/// "35%": 0.35.
double parse_share(const std::string& text);

/// Frames per second as "30" or "30000/1001"; from 0.001 to 10000.
double parse_rate(const std::string& text);

/// Bytes for people: "1.43 MB".
std::string readable_bytes(std::uint64_t bytes);

}  // namespace tvg::cli
