#include "tool/frame_pattern.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

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

/// As printf's %0Nd has it: the sign is one of the places.
std::string padded(std::int64_t number, std::size_t width) {
  const std::string digits = std::to_string(number < 0 ? -number : number);
  const std::string sign = number < 0 ? "-" : "";
  return sign + std::string(width - std::min(width, sign.size() + digits.size()), '0') + digits;
}

}  // namespace

std::string FramePattern::path(std::uint64_t number) const {
  return signed_path(static_cast<std::int64_t>(number));
}

std::string FramePattern::signed_path(std::int64_t number) const {
  std::string expanded;
  for (std::size_t begin = 0; begin < tail.size();) {
    const std::size_t end = std::min(tail.find('/', begin + 1), tail.size());
    const std::string part = tail.substr(begin, end - begin);
    const std::optional<Placeholder> place = find_printf(part);
    expanded +=
        place ? part.substr(0, place->begin) + padded(number, place->width) + part.substr(place->end) : part;
    begin = end;
  }
  return folder + prefix + padded(number, width) + suffix + expanded;
}

std::optional<std::int64_t> FramePattern::number_of(std::string_view name) const {
  if (name.size() <= prefix.size() + suffix.size()) return std::nullopt;
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return std::nullopt;
  std::string_view digits = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  const bool negative = digits.starts_with('-');
  if (negative) digits.remove_prefix(1);
  const std::size_t least = std::max<std::size_t>(width, 1) - (negative && width > 1 ? 1 : 0);
  if (digits.size() > kMaximumWidth || digits.size() < least) return std::nullopt;
  if (!std::all_of(digits.begin(), digits.end(), is_digit)) return std::nullopt;
  if (digits.size() > width && digits.size() > 1 && digits[0] == '0') return std::nullopt;
  std::int64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return negative ? -number : number;
}

std::string FramePattern::text() const {
  return folder + prefix + (width > 1 ? "%0" + std::to_string(width) + "d" : std::string("%d")) + suffix +
         tail;
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

std::optional<FramePattern> parse_input_pattern(const std::string& path) {
  std::optional<FramePattern> last = parse_frame_pattern(path);
  for (const auto find : {find_printf, find_hashes}) {
    if (find == find_hashes && last) break;  // "take#3/walk_%04d.obj"
    for (std::size_t begin = 0; begin < path.size();) {
      const std::size_t end = std::min(path.find('/', begin), path.size());
      const std::string name = path.substr(begin, end - begin);
      const std::optional<Placeholder> place = find(name);
      if (place && end < path.size()) {
        return FramePattern{path.substr(0, begin), name.substr(0, place->begin), name.substr(place->end),
                            place->width, path.substr(end)};
      }
      begin = end + 1;
    }
  }
  return last;
}

std::optional<std::vector<NumberedFile>> numbered_files(const FramePattern& pattern) {
  std::vector<NumberedFile> files;
  std::error_code error;
  std::filesystem::directory_iterator entry(pattern.folder.empty() ? "." : pattern.folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const std::optional<std::int64_t> number = pattern.number_of(name);
    if (!number) continue;
    std::string path = pattern.folder + name;
    if (!pattern.tail.empty()) {
      const std::string whole = pattern.signed_path(*number);
      // What stands behind the folder's name, with its number where it comes again.
      path += whole.substr(whole.find('/', pattern.folder.size()));
    }
    std::error_code ignored;
    if (!std::filesystem::is_directory(path, ignored) && std::filesystem::exists(path, ignored))
      files.push_back({*number, std::move(path)});
  }
  if (error) return std::nullopt;
  std::sort(files.begin(), files.end(), [](const NumberedFile& a, const NumberedFile& b) {
    return a.number != b.number ? a.number < b.number : a.path < b.path;
  });
  return files;
}

}  // namespace tvg::cli
