#include "encoder/importers/collada_keys.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/keyframe_source.hpp"
#include "fuzz/memory_file.hpp"

#include <cstddef>
#include <cstdint>

// What is looked at in a scene before and beside assimp, which is not fuzzed here.

/// The input: the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using tvg::fuzz::MemoryFile;
  const tvg::cli::ColladaKeys keys = tvg::cli::find_collada_keys({reinterpret_cast<const char*>(data), size});
  for (const std::size_t count : keys.counts) tvg::fuzz::require(count > 0 && count <= size);
  const MemoryFile file({data, size}, MemoryFile::Kind::kRegular);
  try {
    tvg::cli::keyframe_count(file.path());
  } catch (const tvg::cli::ImportError&) {
    // An answer as good as any.
  }
  return 0;
}
