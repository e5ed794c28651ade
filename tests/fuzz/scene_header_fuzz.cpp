#include "encoder/importers/glb_header.hpp"
#include "encoder/importers/gltf_keys.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/keyframe_source.hpp"
#include "fuzz/memory_file.hpp"

#include <cstddef>
#include <cstdint>

// What is looked at in a scene before and beside assimp, which is not fuzzed here.

/// The input: the number of a clip, and the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using tvg::fuzz::MemoryFile;
  if (size < 1) return 0;
  tvg::cli::parse_gltf_keys({reinterpret_cast<const char*>(data + 1), size - 1}, data[0]);
  const MemoryFile file({data + 1, size - 1}, MemoryFile::Kind::kRegular);
  try {
    tvg::cli::check_glb_sizes(file.path());
  } catch (const tvg::cli::ImportError&) {
    // An answer as good as any.
  }
  try {
    tvg::cli::keyframe_count(file.path());
  } catch (const tvg::cli::ImportError&) {
    // An answer as good as any.
  }
  return 0;
}
