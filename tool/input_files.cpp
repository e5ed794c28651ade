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

/// Calls `use(path)` for what `path` stands for: the files of a pattern, or itself.
template <class Use>
void for_each_named(const std::string& path, const std::optional<FramePattern>& pattern, Use use) {
  use(path);
  std::error_code ignored;
  if (!pattern || fs::exists(path, ignored)) return;
  for (const NumberedFile& file : numbered_files(*pattern).value_or(std::vector<NumberedFile>{}))
    use(file.path);
}

/// Calls `use(path)` for the mesh files of a folder and, where it has any, of the folders in it.
template <class Use>
void for_each_mesh(const std::string& folder, int depth, Use use) {
  const std::string prefix = folder.ends_with('/') ? folder : folder + '/';
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string path = prefix + entry->path().filename().string();
    std::error_code ignored;
    if (mesh_format(path)) {
      use(path);
    } else if (depth > 0 && entry->is_directory(ignored)) {
      for_each_mesh(path, depth - 1, use);
    }
  }
}

}  // namespace

void InputFiles::add(const std::string& path) {
  const auto add_file = [this](const std::string& file) {
    const std::optional<struct stat> status = regular_file(file, STDIN_FILENO);
    if (status) entries_.push_back({status->st_dev, status->st_ino, file == "-" ? "standard input" : file});
  };
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    for_each_mesh(path, 1, add_file);
  } else {
    for_each_named(path, parse_input_pattern(path), add_file);
  }
}

void InputFiles::add(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) add(path);
  if (paths.size() != 1 || !mesh_format(paths[0])) return;
  for (const std::string& cache : caches_beside(paths[0])) add(cache);
}

void InputFiles::check_output(const std::string& path) const {
  for_each_named(path, parse_frame_pattern(path), [&](const std::string& file) { check_file(file, path); });
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
