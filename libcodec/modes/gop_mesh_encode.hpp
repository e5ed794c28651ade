#pragma once
#include "connectivity/mesh_coder_encode.hpp"
#include "modes/gop_mesh.hpp"
#include "quantization/lattice.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// A mesh to be written: what its GOPs need, and the payload of its chunk.
struct EncodedGopMesh {
  GopMesh mesh;
  std::vector<std::uint8_t> payload;
  std::uint64_t polygons_left_out = 0;
};

/// Without a reference shape. `properties` are those of the mesh, their bits settled.
EncodedGopMesh finish_mesh(EncodedMesh encoded, const MeshProperties& properties);
/// With one: the first frame, positions [vertex][xyz] in the order of the input, on a lattice of such cells
/// or, where it would have too many, of larger ones; or on the lattice `on` where that is given, which holds
/// it. Vertices are predicted from so many neighbours.
Result<EncodedGopMesh> finish_mesh(EncodedMesh encoded, std::span<const float> first_frame, double cell,
                                   std::uint32_t neighbours, const MeshProperties& properties,
                                   const Lattice* on = nullptr);

}  // namespace tvg
