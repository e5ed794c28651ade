#include "tool/input_files.hpp"

#include "tool/frame_pattern.hpp"
#include "tool/mesh_format.hpp"
#include "tool/tool_error.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

/// What the system knows of a regular file; nothing for all else. `standard` stands for "-".
std::optional<struct stat> regular_file(const std::string& path, int standard) {
  struct stat status {};
  const int found = path == "-" ? fstat(standard, &status) : stat(path.c_str(), &status);
  if (found != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return status;
}

/// Calls `use(path)` for each entry of a folder that `wanted(name)` picks.
template <class Wanted, class Use>
void for_each_file(const std::string& folder, Wanted wanted, Use use) {
  const std::string prefix = folder.empty() || folder.ends_with('/') ? folder : folder + '/';
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? "." : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (wanted(name)) use(std::string(prefix).append(name));
  }
}

/// Calls `use(path)` for what `path` stands for: the files of a pattern, or itself.
template <class Use>
void for_each_named(const std::string& path, Use use) {
  use(path);
  std::error_code ignored;
  const std::optional<FramePattern> pattern = parse_frame_pattern(path);
  if (!pattern || fs::exists(path, ignored)) return;
  for_each_file(
      pattern->folder, [&pattern](const std::string& name) { return pattern->number_of(name).has_value(); },
      use);
}

}  // namespace

void InputFiles::add(const std::string& path) {
  const auto add_file = [this](const std::string& file) {
    const std::optional<struct stat> status = regular_file(file, STDIN_FILENO);
    if (status) entries_.push_back({status->st_dev, status->st_ino, file == "-" ? "standard input" : file});
  };
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    for_each_file(
        path, [](const std::string& name) { return mesh_format(name).has_value(); }, add_file);
  } else {
    for_each_named(path, add_file);
  }
}

void InputFiles::add(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) add(path);
}

void InputFiles::check_output(const std::string& path) const {
  for_each_named(path, [&](const std::string& file) { check_file(file, path); });
}

void InputFiles::check_file(const std::string& file, const std::string& asked) const {
  const std::optional<struct stat> status = regular_file(file, STDOUT_FILENO);
  if (!status) return;
  for (const Entry& input : entries_) {
    if (input.device != status->st_dev || input.inode != status->st_ino) continue;
    const std::string name = file == "-" ? "standard output" : file;
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("{}: {} an input: give the output another name{}", name,
                    name == input.name ? "it is" : fmt::format("it is the same file as {},", input.name),
                    asked == file ? "" : fmt::format(" than {}", asked)));
  }
}

}  // namespace tvg::cli
