#include "tool/frame_pattern.hpp"

#include <algorithm>
#include <charconv>

namespace tvg::cli {

namespace {

constexpr std::size_t kMaximumWidth = 18;  // so that every number fits 64 bits

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Where the number goes in a name, and how wide it is.
struct Placeholder {
  std::size_t begin;
  std::size_t end;
  std::size_t width;
};

/// "%d" or "%0Nd".
std::optional<Placeholder> find_printf(std::string_view name) {
  for (std::size_t begin = name.find('%'); begin != name.npos; begin = name.find('%', begin + 1)) {
    std::size_t end = begin + 1;
    std::size_t width = 0;
    if (end < name.size() && name[end] == '0') {
      while (end < name.size() && is_digit(name[end]) && width <= kMaximumWidth) {
        width = 10 * width + static_cast<std::size_t>(name[end++] - '0');
      }
    }
    if (end < name.size() && name[end] == 'd' && width <= kMaximumWidth)
      return Placeholder{begin, end + 1, width};
  }
  return std::nullopt;
}

/// The last run of "#".
std::optional<Placeholder> find_hashes(std::string_view name) {
  const std::size_t last = name.rfind('#');
  if (last == name.npos) return std::nullopt;
  const std::size_t before = name.find_last_not_of('#', last);
  const std::size_t begin = before == name.npos ? 0 : before + 1;
  const std::size_t width = last + 1 - begin;
  if (width > kMaximumWidth) return std::nullopt;
  return Placeholder{begin, last + 1, width};
}

}  // namespace

std::string FramePattern::path(std::uint64_t number) const {
  const std::string digits = std::to_string(number);
  return folder + prefix + std::string(width - std::min(width, digits.size()), '0') + digits + suffix;
}

std::optional<std::uint64_t> FramePattern::number_of(std::string_view file_name) const {
  if (file_name.size() <= prefix.size() + suffix.size()) return std::nullopt;
  if (!file_name.starts_with(prefix) || !file_name.ends_with(suffix)) return std::nullopt;
  const std::string_view digits =
      file_name.substr(prefix.size(), file_name.size() - prefix.size() - suffix.size());
  if (digits.size() > std::max(width, kMaximumWidth) || digits.size() < width) return std::nullopt;
  if (!std::all_of(digits.begin(), digits.end(), is_digit)) return std::nullopt;
  if (digits.size() > width && digits.size() > 1 && digits[0] == '0') return std::nullopt;
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

std::optional<FramePattern> parse_frame_pattern(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::size_t name_begin = slash == path.npos ? 0 : slash + 1;
  const std::string name = path.substr(name_begin);
  std::optional<Placeholder> place = find_printf(name);
  if (!place) place = find_hashes(name);
  if (!place) return std::nullopt;
  return FramePattern{path.substr(0, name_begin), name.substr(0, place->begin), name.substr(place->end),
                      place->width};
}

}  // namespace tvg::cli
