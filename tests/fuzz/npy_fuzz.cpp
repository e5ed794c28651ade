#include "encoder/importers/import_error.hpp"
#include "encoder/importers/npy_source.hpp"
#include "fuzz/memory_file.hpp"
#include "fuzz/require.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

/// The input: the vertices of the mesh less one, and the array.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using tvg::fuzz::MemoryFile;
  if (size < 1 || size > MemoryFile::kMostPiped) return 0;
  const MemoryFile file({data + 1, size - 1}, MemoryFile::Kind::kRegular);
  tvg::Mesh mesh;
  mesh.vertex_count = data[0] + 1U;
  try {
    const auto source = tvg::cli::open_npy(file.path(), mesh, {}, "mesh.obj");
    tvg::FramePositions positions(3 * std::size_t{mesh.vertex_count});
    for (tvg::Result<bool> read = source->read_frame(positions); read && *read;
         read = source->read_frame(positions)) {
      for (const float value : positions) tvg::fuzz::require(std::isfinite(value));
    }
  } catch (const tvg::cli::ImportError&) {
    // An answer as good as any.
  }
  return 0;
}
