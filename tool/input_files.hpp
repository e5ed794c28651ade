#pragma once
#include <string>
#include <sys/types.h>
#include <vector>

namespace tvg::cli {

/// The files a command reads, known by device and inode, so that no output overwrites one of them, whatever
/// links the names go through. Only regular files count: pipes and devices cannot be overwritten.
class InputFiles {
 public:
  /// Adds what a user names: a file, "-" (standard input), a folder (the mesh files in it), a pattern such as
  /// walk_%04d.obj (the files it stands for). What does not exist adds nothing: opening it will tell.
  void add(const std::string& path);
  /// The same of several; a mesh that is the only one brings the cache beside it.
  void add(const std::vector<std::string>& paths);

  /// Throws ToolError (kUsage) where writing `path` would overwrite one of the inputs. `path`: a file, "-"
  /// (standard output), or a pattern, of which every file that exists is looked at.
  void check_output(const std::string& path) const;

 private:
  struct Entry {
    dev_t device;
    ino_t inode;
    std::string name;
  };

  void check_file(const std::string& file, const std::string& asked) const;

  std::vector<Entry> entries_;
};

}  // namespace tvg::cli
