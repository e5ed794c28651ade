#include "bench/sequences.hpp"

#include "encoder/importers/open_source.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

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

Lattice quantize(const Sequence& sequence, int bits) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const FramePositions& frame : sequence.frames) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], double{frame[i]});
      high[i % 3] = std::max(high[i % 3], double{frame[i]});
    }
  }
  Lattice lattice;
  lattice.indices.mesh = sequence.mesh;
  lattice.indices.bits = bits;
  std::copy(low.begin(), low.end(), lattice.minimum);
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  lattice.step = extent / std::exp2(bits);
  const double last = std::exp2(bits) - 1;
  for (const FramePositions& frame : sequence.frames) {
    std::vector<std::uint16_t> indices(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
      indices[i] =
          static_cast<std::uint16_t>(std::min(std::floor((frame[i] - low[i % 3]) / lattice.step), last));
    }
    lattice.indices.frames.push_back(std::move(indices));
  }
  return lattice;
}

std::vector<FramePositions> Lattice::centres() const {
  std::vector<FramePositions> frames;
  for (const std::vector<std::uint16_t>& frame : indices.frames) {
    FramePositions positions(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
      positions[i] = static_cast<float>(minimum[i % 3] + (frame[i] + 0.5) * step);
    }
    frames.push_back(std::move(positions));
  }
  return frames;
}

ComparisonReport compare(const Sequence& original, const std::vector<FramePositions>& decoded) {
  SequenceComparison comparison(original.mesh);
  for (std::size_t f = 0; f < original.frames.size(); ++f) {
    const Status status = comparison.add_frame(original.frames[f], decoded.at(f));
    if (!status.ok()) throw cli::tool_error("comparison", status.error());
  }
  return comparison.report();
}

}  // namespace tvg::bench
