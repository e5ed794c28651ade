#pragma once
#include "tool/atomic_file.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tvg::cli {

/// A folder of files that belong together: none of them appears under its name before all are complete, and
/// where finish() is not reached nothing is left, not even the folder where it was not there before. Files of
/// other names that it has stay. Every failure is a ToolError (kIo) that names the place.
class AtomicFolder {
 public:
  /// Makes the folder, and those above it, where they are missing. kUsage for "-".
  explicit AtomicFolder(std::string path);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::string& path() const { return path_; }
  /// A file to be written; it lives as long as the folder and is not to be finished by itself.
  AtomicFile& add(const std::string& name);
  /// A file with these bytes.
  void add(const std::string& name, std::string_view bytes);
  /// Gives all files their names, in the order in which they were added: the last is what leads to the
  /// others.
  void finish();

 private:
  std::string path_;
  std::vector<std::filesystem::path> made_;  // folders, the outermost last
  std::vector<std::unique_ptr<AtomicFile>> files_;
  bool finished_ = false;
};

}  // namespace tvg::cli
