#include "encoder/importers/read_notes.hpp"

#include <fmt/format.h>

namespace tvg::cli {

std::vector<std::string> ReadNotes::texts() const {
  std::vector<std::string> texts;
  for (const auto& [note, files] : files_) {
    const std::size_t more = files.size() - 1;
    texts.push_back(more == 0 ? fmt::format("{}: {}", *files.begin(), note)
                              : fmt::format("{} and {} more file{}: {}", *files.begin(), more,
                                            more == 1 ? "" : "s", note));
  }
  return texts;
}

}  // namespace tvg::cli
