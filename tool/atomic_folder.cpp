#include "tool/atomic_folder.hpp"

#include "tool/tool_error.hpp"

#include <fmt/format.h>
#include <system_error>

namespace tvg::cli {

namespace fs = std::filesystem;

AtomicFolder::AtomicFolder(std::string path) : path_(std::move(path)) {
  if (path_ == "-") throw ToolError(ExitStatus::kUsage, "-: standard output is no folder");
  std::error_code error;
  for (fs::path folder = fs::absolute(path_).lexically_normal(); !fs::exists(folder, error) && !error;
       folder = folder.parent_path()) {
    if (folder.has_filename()) made_.push_back(folder);
  }
  fs::create_directories(path_, error);
  if (!error && !fs::is_directory(path_, error)) error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw ToolError(ExitStatus::kIo,
                    fmt::format("{}: the folder cannot be made: {}", path_, error.message()));
}

AtomicFolder::~AtomicFolder() {
  if (finished_) return;
  files_.clear();
  std::error_code ignored;  // where others put something in, it stays
  for (const fs::path& folder : made_) fs::remove(folder, ignored);
}

AtomicFile& AtomicFolder::add(const std::string& name) {
  return *files_.emplace_back(std::make_unique<AtomicFile>((fs::path(path_) / name).string()));
}

void AtomicFolder::add(const std::string& name, std::string_view bytes) {
  add(name).write(bytes);
}

void AtomicFolder::finish() {
  // What may fail for want of room does so before the first has its name.
  for (const auto& file : files_) file->flush();
  finished_ = true;
  for (const auto& file : files_) file->finish();
}

}  // namespace tvg::cli
