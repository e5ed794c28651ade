#pragma once
#include "encoder/importers/open_source.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::test {

struct RealSequence {
  std::string name;
  Sequence sequence;
};

/// The first frames of the sequences in the folder that TVG_DATA_DIR names; none where it names none.
inline std::vector<RealSequence> real_sequences(std::size_t frame_count) {
  const char* const variable = std::getenv("TVG_DATA_DIR");
  const std::filesystem::path folder = variable != nullptr ? variable : "";
  std::vector<RealSequence> sequences;
  if (!std::filesystem::is_directory(folder)) return sequences;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".obj") continue;
    std::filesystem::path cache = file.path();
    cache.replace_extension(".pc2");
    const cli::OpenedSource opened = cli::open_source({{file.path().string(), cache.string()}, {}});
    RealSequence real{file.path().stem().string(), {opened.source->mesh(), {}, {}}};
    FramePositions frame(3 * std::size_t{real.sequence.mesh.vertex_count});
    while (real.sequence.frames.size() < frame_count) {
      const Result<bool> read = opened.source->read_frame(frame);
      if (!read || !*read) break;
      real.sequence.frames.push_back(frame);
    }
    sequences.push_back(std::move(real));
  }
  return sequences;
}

}  // namespace tvg::test
