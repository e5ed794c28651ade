#include "encoder/importers/cache_source.hpp"
#include "encoder/importers/import_error.hpp"
#include "fuzz/memory_file.hpp"
#include "fuzz/require.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace {

using tvg::fuzz::MemoryFile;
using tvg::fuzz::require;

// Bits of the input's first byte.
constexpr std::uint8_t kPipe = 1;
constexpr std::uint8_t kOpenEnded = 2;
constexpr std::uint8_t kRewind = 4;
constexpr std::uint8_t kSkip = 8;

void read_frames(tvg::FrameSource& source) {
  tvg::FramePositions positions(3 * std::size_t{source.mesh().vertex_count});
  for (;;) {
    const tvg::Result<bool> read = source.read_frame(positions);
    if (!read || !*read) return;
    for (const float value : positions) require(std::isfinite(value));
  }
}

}  // namespace

/// The input: a byte of options, the vertices of the mesh less one, and the cache, PC2 or MDD.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > MemoryFile::kMostPiped) return 0;
  const std::uint8_t options = data[0];
  const MemoryFile file({data + 2, size - 2},
                        (options & kPipe) != 0 ? MemoryFile::Kind::kPipe : MemoryFile::Kind::kRegular);
  tvg::Mesh mesh;
  mesh.vertex_count = data[1] + 1U;
  std::vector<std::string> notes;
  try {
    const auto source = tvg::cli::open_cache(file.path(), mesh, {}, "mesh.obj", notes,
                                             {.open_ended = (options & kOpenEnded) != 0});
    if ((options & kSkip) != 0 && !source->skip_frames(source->frame_count().value_or(1) / 2).ok()) return 0;
    read_frames(*source);
    if ((options & kRewind) != 0 && source->rewind()) read_frames(*source);
  } catch (const tvg::cli::ImportError&) {
    // An answer as good as any.
  }
  return 0;
}
