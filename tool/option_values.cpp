#include "tool/option_values.hpp"

#include "tool/tool_error.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <utility>

namespace tvg::cli {

namespace {

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The numbers before and after `separator`; the same number twice where there is none.
template <class T>
std::optional<std::pair<T, T>> pair_of(std::string_view text, char separator) {
  const std::size_t at = text.find(separator, 1);
  const std::optional<T> first = number<T>(text.substr(0, at));
  const std::optional<T> second = at == std::string_view::npos ? first : number<T>(text.substr(at + 1));
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

}  // namespace

FrameRange parse_frame_range(const std::string& text) {
  const auto range = pair_of<std::uint64_t>(text, '-');
  if (!range || range->first > range->second) {
    fail_option("--frames", text, "write the first and the last frame, counted from 0, as 0-49");
  }
  return {range->first, range->second};
}

void check_frame_range(const FrameRange& range, std::uint64_t frame_count, const std::string& input) {
  if (range.first > range.last) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("frames {}-{}: the first comes after the last", range.first, range.last));
  }
  if (range.last >= frame_count) {
    throw ToolError(ExitStatus::kUsage, fmt::format("frames {}-{} are asked for, but {} has the frames 0-{}",
                                                    range.first, range.last, input, frame_count - 1));
  }
}

BitPair parse_bits(const std::string& text) {
  const auto bits = pair_of<int>(text, ':');
  if (!bits || bits->first < 1 || bits->first > 24 || bits->second < 1 || bits->second > bits->first) {
    fail_option("--bits", text,
                "write the bits of important and of other vertices as 13:11, or one number for all; 1 to 24, "
                "the first "
                "at least the second");
  }
  return {bits->first, bits->second};
}

StepPair parse_step(const std::string& text) {
  const auto steps = pair_of<double>(text, ':');
  const std::string right =
      "write the step of important and of other vertices in the mesh's units as 0.01:0.04, the second 1, 2, "
      "4, 8, ... "
      "times the first, or one number for all";
  if (!steps || !(steps->first > 0) || !std::isfinite(steps->first) || !(steps->second >= steps->first)) {
    fail_option("--step", text, right);
  }
  const double ratio = steps->second / steps->first;
  const double shift = std::round(std::log2(ratio));
  if (shift > 23 || std::abs(ratio - std::exp2(shift)) > 1e-6 * ratio) fail_option("--step", text, right);
  return {steps->first, static_cast<int>(shift)};
}

double parse_share(const std::string& text) {
  const bool percent = !text.empty() && text.back() == '%';
  const std::optional<double> value =
      percent ? number<double>(std::string_view(text).substr(0, text.size() - 1)) : std::nullopt;
  if (!value || !(*value >= 0 && *value <= 100)) {
    fail_option("--important", text, "write the share of important vertices as 35%");
  }
  return *value / 100;
}

double parse_number(const std::string& option, const std::string& text, const NumberRange& range) {
  const std::optional<double> value = number<double>(text);
  const bool within = value && std::isfinite(*value) && *value <= range.most &&
                      (range.least_excluded ? *value > range.least : *value >= range.least);
  if (within) return *value;
  constexpr NumberRange kAll;
  if (range.most < kAll.most) {
    fail_option(option, text, fmt::format("write a number from {} to {}", range.least, range.most));
  }
  if (range.least == kAll.least) fail_option(option, text, "write a number, such as 0.5");
  fail_option(
      option, text,
      fmt::format("write a number {} {}", range.least_excluded ? "above" : "of at least", range.least));
}

std::uint64_t parse_count(const std::string& option, const std::string& text) {
  const std::optional<std::uint64_t> value = number<std::uint64_t>(text);
  if (!value) fail_option(option, text, "write a whole number, counted from 0");
  return *value;
}

std::optional<double> parse_positive(std::string_view text) {
  const std::optional<double> value = number<double>(text);
  if (!value || !std::isfinite(*value) || !(*value > 0)) return std::nullopt;
  return value;
}

std::optional<double> parse_frame_rate(std::string_view text) {
  constexpr double kLowest = 0.01, kHighest = 1000;
  const std::size_t slash = text.find('/');
  const std::optional<double> above = parse_positive(text.substr(0, slash));
  std::optional<double> below = 1.0;
  if (slash != std::string_view::npos) below = parse_positive(text.substr(slash + 1));
  if (!above || !below) return std::nullopt;
  const double rate = *above / *below;
  if (!(rate >= kLowest && rate <= kHighest)) return std::nullopt;
  return rate;
}

std::optional<std::pair<int, int>> parse_count_pair(std::string_view text, int most) {
  const std::size_t at = text.find('x');
  if (at == std::string_view::npos) return std::nullopt;
  const auto number = [most](std::string_view part) {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    const bool whole = error == std::errc() && end == part.data() + part.size();
    return whole && value >= 1 && value <= most ? value : 0;
  };
  const std::pair pair(number(text.substr(0, at)), number(text.substr(at + 1)));
  if (pair.first == 0 || pair.second == 0) return std::nullopt;
  return pair;
}

void fail_option(const std::string& option, const std::string& text, const std::string& right) {
  throw ToolError(ExitStatus::kUsage, fmt::format("{} {}: {}", option, text, right));
}

double parse_rate(const std::string& text) {
  const std::optional<double> rate = parse_frame_rate(text);
  if (!rate) fail_option("--fps", text, kFrameRateHelp);
  return *rate;
}

std::string readable_bytes(std::uint64_t bytes) {
  constexpr std::array<std::string_view, 4> kUnits = {"kB", "MB", "GB", "TB"};
  if (bytes < 1000) return fmt::format("{} B", bytes);
  double value = static_cast<double>(bytes) / 1000;
  std::size_t unit = 0;
  for (; value >= 1000 && unit + 1 < kUnits.size(); ++unit) value /= 1000;
  return fmt::format("{:.{}f} {}", value, value < 10 ? 2 : value < 100 ? 1 : 0, kUnits[unit]);
}

}  // namespace tvg::cli
