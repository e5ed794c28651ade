#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <tvg/types.hpp>

// Values of options as users type them. Every function throws ToolError (kUsage) that shows what would be
// right.
namespace tvg::cli {

/// "A-B": frames A to B, both included, or "A" for one frame.
FrameRange parse_frame_range(const std::string& text);
/// Throws ToolError (kUsage) unless the range lies within `frame_count` frames of `input`.
void check_frame_range(const FrameRange& range, std::uint64_t frame_count, const std::string& input);

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

/// Where a number may lie: from `least`, or above it, to `most`.
struct NumberRange {
  double least = std::numeric_limits<double>::lowest();
  double most = std::numeric_limits<double>::max();
  bool least_excluded = false;
};
/// The value of an option that takes a number. Throws ToolError (kUsage) for what is none, nan and inf among
/// it, or lies outside the range.
double parse_number(const std::string& option, const std::string& text, const NumberRange& range);

/// The value of an option that counts, such as a frame's number. Throws ToolError (kUsage) for what is no
/// whole number from 0 on.
std::uint64_t parse_count(const std::string& option, const std::string& text);

/// A finite number above 0; nothing where the text is none.
std::optional<double> parse_positive(std::string_view text);

/// How a frame rate is written, for messages.
inline constexpr const char* kFrameRateHelp =
    "write frames per second as 30, 29.97 or 30000/1001, from 0.01 to 1000";
/// Frames per second, as metadata and options have them: "30", "29.97" or "30000/1001"; nothing where the
/// text is no rate between 0.01 and 1000.
std::optional<double> parse_frame_rate(std::string_view text);

/// "4x3": two counts from 1 to `most`; nothing where the text is none.
std::optional<std::pair<int, int>> parse_count_pair(std::string_view text, int most);

/// Throws ToolError (kUsage): "OPTION TEXT: what would be right".
[[noreturn]] void fail_option(const std::string& option, const std::string& text, const std::string& right);

/// The value of --fps, as parse_frame_rate() has it. Throws ToolError (kUsage).
double parse_rate(const std::string& text);

/// Bytes for people: "1.43 MB".
std::string readable_bytes(std::uint64_t bytes);

}  // namespace tvg::cli
