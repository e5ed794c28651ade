#include "encoder/importers/sequence_files.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/name_patterns.hpp"
#include "tool/frame_pattern.hpp"
#include "tool/mesh_format.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

// A hold over more frames than that is a name that counts something else.
constexpr std::uint64_t kMostHeld = 1'000'000;

[[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::kInvalidInput) {
  throw ImportError(code, what);
}

/// Names of the entries of a folder, folders themselves or else all others.
std::vector<std::string> entry_names(const std::string& folder, bool folders) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? "." : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    std::string name = entry->path().filename().string();
    if (entry->is_directory(ignored) == folders && !name.starts_with('.')) names.push_back(std::move(name));
  }
  if (error) fail(fmt::format("cannot read folder {}: {}", folder, error.message()), ErrorCode::kIo);
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

std::vector<std::string> mesh_names(const std::string& folder) {
  std::vector<std::string> names = entry_names(folder, false);
  std::erase_if(names, [](const std::string& name) { return !mesh_format(name); });
  return names;
}

std::string count_of(std::size_t files) {
  return files == 1 ? "1 file" : fmt::format("{} files", files);
}

/// Names for a message, not too many.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 4;
  const std::vector<std::string> shown(
      names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, names.size())));
  const std::string more = names.size() > kShown ? fmt::format(" and {} more", names.size() - kShown) : "";
  return fmt::format("{}{}", fmt::join(shown, ", "), more);
}

/// Files by number as frames: numbers that are not there are gaps, unless all of them are one step apart.
void take_numbered(const FramePattern& pattern, const std::vector<NumberedFile>& files, Gaps gaps,
                   SequenceFiles& result) {
  std::int64_t step = files.size() > 1 ? files[1].number - files[0].number : 1;
  std::uint64_t missing = 0;
  std::size_t first_gap = 0;
  for (std::size_t i = 1; i < files.size(); ++i) {
    const std::int64_t distance = files[i].number - files[i - 1].number;
    if (distance == 0) {
      fail(fmt::format("{} and {} have the same number {}", files[i - 1].path, files[i].path,
                       files[i].number));
    }
    if (distance != step) step = 1;
    if (distance > 1 && missing == 0) first_gap = i;
    missing += static_cast<std::uint64_t>(distance) - 1;
  }
  if (missing > 0 && step == 1 && gaps == Gaps::kRefuse) {
    const std::int64_t before = files[first_gap - 1].number;
    fail(
        fmt::format("{} is missing: the sequence has the numbers {} and {}, but none between them. `--gaps "
                    "hold` shows the frame before a gap until it ends, `--gaps skip` goes on with the next",
                    pattern.signed_path(before + 1), before, files[first_gap].number));
  }
  if (gaps == Gaps::kHold && missing > kMostHeld) {
    fail(fmt::format("{}: {} numbers are missing between {} and {}: too many to hold a frame over",
                     pattern.text(), missing, files.front().number, files.back().number));
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (gaps == Gaps::kHold && i > 0) {
      for (std::int64_t held = files[i - 1].number + 1; held < files[i].number; ++held)
        result.files.push_back(files[i - 1].path);
    }
    result.files.push_back(files[i].path);
  }
  if (missing == 0) return;
  if (gaps == Gaps::kHold) {
    result.notes.push_back(
        fmt::format("{}: {} numbers between {} and {} are missing: the frame before them is held",
                    pattern.text(), missing, files.front().number, files.back().number));
  } else if (step > 1) {
    result.notes.push_back(
        fmt::format("{}: every {}th number from {} to {} is there: they are taken as {} frames "
                    "in a row (`--gaps hold` holds each until the next)",
                    pattern.text(), step, files.front().number, files.back().number, files.size()));
  } else {
    result.notes.push_back(fmt::format("{}: {} numbers between {} and {} are missing and left out",
                                       pattern.text(), missing, files.front().number, files.back().number));
  }
}

/// The pattern of all names but single ones that are named otherwise. Throws where that is not plain.
NamePattern one_pattern(const std::string& where, const std::vector<std::string>& names,
                        const std::string& folder) {
  NamePattern pattern = common_pattern(names);
  pattern.pattern.folder = folder;
  const std::vector<std::string> others = names_without(names, pattern);
  if (others.empty()) return pattern;
  const auto other_format = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return mesh_format(name) != mesh_format(names[0]);
  });
  const std::string example = pattern.files.size() > 1 ? pattern.pattern.text() : folder + "frame_%04d.obj";
  if (pattern.files.size() < 2 && other_format != names.end()) {
    fail(fmt::format("{} mixes formats ({} and {}): give a pattern such as {}", where, names[0],
                     *other_format, example));
  }
  if (pattern.files.size() < 2) {
    fail(fmt::format(
        "{} has files that are not named as one sequence ({}): give a pattern such as {}, or list "
        "the files themselves",
        where, some_of(names), example));
  }
  NamePattern second = common_pattern(others);
  second.pattern.folder = folder;
  if (second.files.size() > 1) {
    fail(fmt::format("{} has more than one sequence: give one of the patterns {} ({}) and {} ({})", where,
                     pattern.pattern.text(), count_of(pattern.files.size()), second.pattern.text(),
                     count_of(second.files.size())));
  }
  return pattern;
}

void put_before(const std::string& folder, std::vector<NumberedFile>& files) {
  for (NumberedFile& file : files) file.path.insert(0, folder);
}

/// What a folder's pattern is and what of the folder it leaves out.
void note_choice(const std::string& folder, const NamePattern& chosen, const std::vector<std::string>& others,
                 SequenceFiles& result) {
  if (chosen.files.size() > 1) {
    result.notes.push_back(fmt::format("folder {}: {}, {} with the numbers {} to {}", folder,
                                       chosen.pattern.text(), count_of(chosen.files.size()),
                                       chosen.files.front().number, chosen.files.back().number));
  }
  if (!others.empty()) {
    result.notes.push_back(fmt::format("folder {}: left out, not named so: {}", folder, some_of(others)));
  }
}

/// Folders by number, each with one mesh file.
SequenceFiles find_frame_folders(const std::string& folder, const std::string& prefix,
                                 const std::vector<std::string>& names, Gaps gaps) {
  NamePattern pattern = one_pattern("folder " + folder, names, prefix);
  SequenceFiles result;
  note_choice(folder, pattern, names_without(names, pattern), result);
  for (NumberedFile& frame : pattern.files) {
    const std::string inside = prefix + frame.path + "/";
    const std::vector<std::string> meshes = mesh_names(inside);
    if (meshes.size() != 1) {
      fail(fmt::format("folder {} holds {} where one mesh file should be: give a pattern such as {}/mesh.obj",
                       inside, meshes.empty() ? "no mesh file" : some_of(meshes), pattern.pattern.text()));
    }
    frame.path = inside + meshes[0];
  }
  take_numbered(pattern.pattern, pattern.files, gaps, result);
  return result;
}

void require_one_format(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (mesh_format(file) != mesh_format(files[0]))
      fail(fmt::format("{} and {} are of different formats: one sequence has one", files[0], file));
  }
}

}  // namespace

std::optional<SequenceFiles> find_pattern_files(const std::string& path, Gaps gaps) {
  const std::optional<FramePattern> pattern = parse_input_pattern(path);
  std::error_code ignored;
  if (!pattern || fs::exists(path, ignored)) return std::nullopt;
  const auto files = numbered_files(*pattern);
  if (!files) {
    std::error_code error;
    const fs::directory_iterator entry(pattern->folder.empty() ? "." : pattern->folder, error);
    fail(fmt::format("cannot read folder {}: {}", pattern->folder, error.message()), ErrorCode::kIo);
  }
  if (files->empty()) {
    const std::string around = sequence_around(path);
    fail(fmt::format("no file is named {} (for example {}){}", path, pattern->path(0),
                     around.empty() ? "" : fmt::format("; there is {}", around)),
         ErrorCode::kIo);
  }
  SequenceFiles result;
  take_numbered(*pattern, *files, gaps, result);
  return result;
}

SequenceFiles find_folder_files(const std::string& folder, Gaps gaps) {
  const std::string prefix = folder.ends_with('/') ? folder : folder + "/";
  for (const std::string& name : entry_names(folder, false)) {
    if (is_cache_file(name)) {
      fail(fmt::format("folder {} holds a cache, {}: name the mesh and the cache instead of the folder",
                       folder, name));
    }
  }
  const std::vector<std::string> names = mesh_names(folder);
  if (names.empty()) {
    const std::vector<std::string> folders = entry_names(folder, true);
    const bool any = std::any_of(folders.begin(), folders.end(),
                                 [&](const std::string& name) { return !mesh_names(prefix + name).empty(); });
    if (any) return find_frame_folders(folder, prefix, folders, gaps);
    fail(fmt::format("folder {} holds no .obj, .ply, .off or .stl files", folder));
  }
  NamePattern pattern = one_pattern("folder " + folder, names, prefix);
  SequenceFiles result;
  note_choice(folder, pattern, names_without(names, pattern), result);
  put_before(prefix, pattern.files);
  take_numbered(pattern.pattern, pattern.files, gaps, result);
  return result;
}

SequenceFiles order_listed_files(std::vector<std::string> files, Gaps gaps) {
  std::sort(files.begin(), files.end(), natural_less);
  if (const auto twice = std::adjacent_find(files.begin(), files.end()); twice != files.end())
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("{} is named twice among the files of a sequence", *twice));
  require_one_format(files);
  const NamePattern pattern = common_pattern(files);
  const std::vector<std::string> others = names_without(files, pattern);
  SequenceFiles result;
  if (others.empty()) {
    take_numbered(pattern.pattern, pattern.files, gaps, result);
    return result;
  }
  if (pattern.files.size() > 1 && others.size() < pattern.files.size()) {
    fail(
        fmt::format("{} {} not named as the other files are ({}): give the pattern instead of the list, or "
                    "a list without {}",
                    some_of(others), others.size() == 1 ? "is" : "are", pattern.pattern.text(),
                    others.size() == 1 ? "it" : "them"));
  }
  result.notes.push_back(fmt::format("the files are taken in the order {}", some_of(files)));
  result.files = std::move(files);
  return result;
}

std::string sequence_around(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == path.npos ? "" : path.substr(0, slash + 1);
  std::error_code ignored;
  if (!fs::is_directory(folder.empty() ? "." : folder, ignored)) return "";
  std::vector<std::string> names = mesh_names(folder);
  const bool known = std::find(names.begin(), names.end(), path.substr(folder.size())) != names.end();
  if (!known)
    std::erase_if(names, [&](const std::string& name) { return mesh_format(name) != mesh_format(path); });
  NamePattern pattern = common_pattern(names);
  pattern.pattern.folder = folder;
  if (pattern.files.size() < 2) return "";
  put_before(folder, pattern.files);
  const bool is_one = std::any_of(pattern.files.begin(), pattern.files.end(),
                                  [&](const NumberedFile& file) { return file.path == path; });
  if (known && !is_one) return "";
  return fmt::format("{} ({})", pattern.pattern.text(), count_of(pattern.files.size()));
}

}  // namespace tvg::cli
