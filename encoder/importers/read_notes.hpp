#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tvg::cli {

/// What comes to light while frames are read, which is after the notes of opening are told. Frames that are
/// read twice say it once.
class ReadNotes {
 public:
  void add(const std::string& file, const std::string& note) { files_[note].insert(file); }
  /// "f_001.obj and 3 more files: 1 face with fewer than three corners left out".
  std::vector<std::string> texts() const;

 private:
  std::map<std::string, std::set<std::string>> files_;  // of each note
};

}  // namespace tvg::cli
