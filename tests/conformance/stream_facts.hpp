#pragma once
#include <cstdint>
#include <istream>
#include <span>
#include <string>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::conformance {

/// What a stream decodes to: a line of corpus/conformance/digests.txt. Digests are XXH64 with seed 0 over
/// little-endian values.
struct StreamFacts {
  std::uint64_t bytes = 0, frames = 0;
  std::uint64_t vertices = 0, faces = 0;  ///< summed over the meshes
  std::uint64_t lattice_digest = 0;       ///< int32 indices of every frame, [frame][vertex][xyz]
  std::uint64_t positions_digest = 0;     ///< float32 coordinates of every frame, [frame][vertex][xyz]
  std::uint64_t faces_digest = 0;         ///< uint32 corners of every mesh, [mesh][face][corner]
  std::uint64_t properties_digest = 0;    ///< attributes, parts and polygons, as corpus/manifest.md says

  bool operator==(const StreamFacts&) const = default;
};

/// Decodes a whole stream, which must be without damage, drawn as this lod.
Result<StreamFacts> read_stream_facts(std::span<const std::uint8_t> stream, std::uint32_t lod = 0);

struct NamedFacts {
  std::string name;
  StreamFacts facts;
};

/// What lods.txt calls a lod of a stream.
std::string lod_name(const std::string& stream, std::uint32_t lod);

/// The first line of digests.txt, which names its columns.
std::string facts_heading();
std::string facts_line(const NamedFacts& entry);
/// The entries of digests.txt, or of lods.txt.
std::vector<NamedFacts> read_facts(std::istream& file);

}  // namespace tvg::conformance
