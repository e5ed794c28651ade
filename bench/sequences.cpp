#include "bench/sequences.hpp"

#include "encoder/importers/open_source.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace tvg::bench {

std::string default_data_folder() {
  const char* folder = std::getenv("TVG_DATA_DIR");
  return folder != nullptr ? folder : "";
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(folder, absent)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".obj") continue;
    if (std::filesystem::exists(std::filesystem::path(path).replace_extension(".pc2"))) {
      names.push_back(path.stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

NamedSequence load(const std::string& folder, const std::string& name) {
  const std::string cache = folder + "/" + name + ".pc2";
  const auto source = cli::open_source({{folder + "/" + name + ".obj", cache}, {}}).source;

  NamedSequence result{name, {}};
  result.sequence.mesh = source->mesh();
  for (;;) {
    FramePositions frame(3 * std::size_t{source->mesh().vertex_count});
    const Result<bool> read = source->read_frame(frame);
    if (!read) throw cli::tool_error(cache, read.error());
    if (!*read) return result;
    result.sequence.frames.push_back(std::move(frame));
  }
}

Sequence first_frames(const Sequence& sequence, std::size_t count) {
  const auto end = static_cast<std::ptrdiff_t>(std::min(count, sequence.frames.size()));
  return {sequence.mesh, {sequence.frames.begin(), sequence.frames.begin() + end}, sequence.metadata};
}

}  // namespace tvg::bench
