#include "cli/open_source_files.hpp"

#include "cli/input_options.hpp"

namespace tvg::cli {

SourceOpener source_opener(const std::string& skeleton) {
  return [skeleton](const std::vector<std::string>& inputs, const std::optional<FrameRange>& frames) {
    return open_with_joints({inputs, frames}, skeleton).source;
  };
}

}  // namespace tvg::cli
