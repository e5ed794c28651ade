#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_sequence.hpp"
#include "tool/frame_pattern.hpp"
#include "tool/mesh_format.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The digits that start at `begin`, without leading zeros.
std::string_view digits_at(std::string_view name, std::size_t begin, std::size_t& end) {
  end = begin;
  while (end < name.size() && is_digit(name[end])) ++end;
  while (begin + 1 < end && name[begin] == '0') ++begin;
  return name.substr(begin, end - begin);
}

/// Runs of digits compare as numbers, all else as characters.
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < a.size() && k < b.size()) {
    if (is_digit(a[i]) && is_digit(b[k])) {
      const std::string_view x = digits_at(a, i, i);
      const std::string_view y = digits_at(b, k, k);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[k]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[k]);
      ++i;
      ++k;
    }
  }
  if (a.size() - i != b.size() - k) return a.size() - i < b.size() - k;
  return a < b;
}

/// Names of the entries of a folder that are not folders themselves.
std::vector<std::string> file_names(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? "." : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    std::string name = entry->path().filename().string();
    if (!entry->is_directory(ignored) && !name.starts_with('.')) names.push_back(std::move(name));
  }
  if (error)
    throw ImportError(ErrorCode::kIo, fmt::format("cannot read folder {}: {}", folder, error.message()));
  return names;
}

/// The last number in a name, with what stands before and after it.
std::optional<std::pair<FramePattern, std::uint64_t>> split_number(const std::string& name) {
  std::size_t end = name.size();
  while (end > 0 && !is_digit(name[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_digit(name[begin - 1])) --begin;
  std::uint64_t number = 0;
  const auto [after, error] = std::from_chars(name.data() + begin, name.data() + end, number);
  if (error != std::errc{} || after != name.data() + end) return std::nullopt;
  return std::pair{FramePattern{"", name.substr(0, begin), name.substr(end), end - begin}, number};
}

[[noreturn]] void fail_missing(const std::string& missing, std::uint64_t before, std::uint64_t after) {
  throw ImportError(
      ErrorCode::kInvalidInput,
      fmt::format("{} is missing: the sequence has the numbers {} and {}, but none between them", missing,
                  before, after));
}

/// Complains about the first number left out where all names are alike but for one number.
void check_gaps(const std::string& folder, const std::vector<std::string>& sorted_names) {
  std::optional<std::pair<FramePattern, std::uint64_t>> previous;
  for (const std::string& name : sorted_names) {
    auto current = split_number(name);
    if (!current) return;
    if (previous && (previous->first.prefix != current->first.prefix ||
                     previous->first.suffix != current->first.suffix)) {
      return;
    }
    previous = std::move(current);
  }
  previous.reset();
  for (const std::string& name : sorted_names) {
    auto current = split_number(name);
    if (previous && current->second == previous->second) {
      throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}{} and another file have the same number {}",
                                                              folder, name, current->second));
    }
    if (previous && current->second != previous->second + 1) {
      previous->first.folder = folder;
      fail_missing(previous->first.path(previous->second + 1), previous->second, current->second);
    }
    previous = std::move(current);
  }
}

}  // namespace

std::optional<std::vector<std::string>> find_pattern_files(const std::string& path) {
  const std::optional<FramePattern> pattern = parse_frame_pattern(path);
  std::error_code ignored;
  if (!pattern || fs::exists(path, ignored)) return std::nullopt;
  std::vector<std::uint64_t> numbers;
  for (const std::string& name : file_names(pattern->folder)) {
    if (const auto number = pattern->number_of(name)) numbers.push_back(*number);
  }
  if (numbers.empty()) {
    throw ImportError(ErrorCode::kIo,
                      fmt::format("no file is named {} (for example {})", path, pattern->path(0)));
  }
  std::sort(numbers.begin(), numbers.end());
  std::vector<std::string> files;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && numbers[i] != numbers[i - 1] + 1) {
      fail_missing(pattern->path(numbers[i - 1] + 1), numbers[i - 1], numbers[i]);
    }
    files.push_back(pattern->path(numbers[i]));
  }
  return files;
}

std::vector<std::string> find_folder_files(const std::string& folder) {
  const std::string prefix = folder.ends_with('/') ? folder : folder + "/";
  std::vector<std::string> names;
  for (std::string& name : file_names(folder)) {
    if (is_cache_file(name)) {
      throw ImportError(
          ErrorCode::kInvalidInput,
          fmt::format("folder {} holds a cache, {}: name the mesh and the cache instead of the folder",
                      folder, name));
    }
    if (mesh_format(name)) names.push_back(std::move(name));
  }
  if (names.empty()) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("folder {} holds no .obj, .ply, .off or .stl files", folder));
  }
  std::sort(names.begin(), names.end(), natural_less);
  for (const std::string& name : names) {
    if (mesh_format(name) != mesh_format(names[0])) {
      throw ImportError(
          ErrorCode::kInvalidInput,
          fmt::format("folder {} mixes formats ({} and {}): give a pattern such as {}frame_%04d.obj", folder,
                      names[0], name, prefix));
    }
  }
  check_gaps(prefix, names);
  for (std::string& name : names) name.insert(0, prefix);
  return names;
}

}  // namespace tvg::cli
