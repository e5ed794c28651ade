#pragma once
#include "base/byte_io.hpp"

#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// §4.3: counts and the two coded parts; `order` is empty when the vertex order was given up.
struct MeshLayout {
  std::uint32_t vertex_count, face_count;
  bool keeps_order;
  Bytes connectivity, order;
};
std::vector<std::uint8_t> write_mesh(const MeshLayout& mesh);
Result<MeshLayout> read_mesh(Bytes payload);

/// The longest payload a mesh chunk of such a stream may have.
constexpr std::uint64_t most_mesh_bytes(const StreamLimits& limits) {
  return 64 + 16 * (std::uint64_t{limits.vertices} + limits.faces);
}

/// Whether a mesh is as small as the head says.
Status check_mesh_size(const MeshLayout& mesh, const StreamLimits& limits);

}  // namespace tvg
