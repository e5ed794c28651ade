#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"
#include "connectivity/connectivity.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/levels.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A coarser mesh as its section has it (format-spec §5.6).
struct CoarseLayout {
  std::uint32_t levels = 0;  ///< it has the vertices of levels below
  std::uint32_t vertex_count = 0, face_count = 0;
  Bytes connectivity, order;
};

/// All of a mesh, the finest first.
struct CoarseLayouts {
  std::array<CoarseLayout, kMaxCoarseMeshes> meshes;
  std::size_t count = 0;
};

/// Reads all of a section, of a mesh with so many faces, into `layouts`, whose parts lie in the section.
Fault read_coarse_layouts(Bytes section, std::uint32_t face_count, CoarseLayouts& layouts);
/// Whether the coarser meshes have the vertices of levels that there are, [vertex].
Fault check_coarse_layouts(const CoarseLayouts& layouts, std::span<const std::uint8_t> levels);

/// A coarser mesh over some of a mesh's vertices, in the order that the mesh has them in.
struct CoarseCut {
  Mesh mesh;
  std::vector<std::uint32_t> vertices;  ///< [vertex]: its traversal index in the whole mesh, each once
  std::vector<std::uint32_t> numbers;   ///< [vertex]: its number in the whole mesh, ascending

  bool whole() const { return vertices.empty(); }
};

/// Decodes a coarser mesh of the mesh whose vertices have these levels, [traversal index], and this order,
/// [traversal index]: vertex. The layout fits the levels. kMalformed, kLimitExceeded, kOutOfMemory.
Result<CoarseCut> decode_coarse_mesh(const CoarseLayout& layout, std::span<const std::uint8_t> levels,
                                     std::span<const std::uint32_t> order);

}  // namespace tvg
