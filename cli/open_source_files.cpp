#include "cli/open_source_files.hpp"

#include "encoder/importers/open_source.hpp"

namespace tvg::cli {

SourceOpener source_opener() {
  return [](const std::vector<std::string>& inputs, const std::optional<FrameRange>& frames) {
    return open_source({inputs, frames}).source;
  };
}

}  // namespace tvg::cli
