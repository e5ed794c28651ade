#pragma once
#include "base/byte_io.hpp"
#include "connectivity/coarse_mesh.hpp"
#include "connectivity/connectivity.hpp"
#include "container/mesh_payload.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/levels.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A mesh as the coding of frames needs it, on either side.
struct CodedMesh {
  Mesh mesh;                         ///< in the order frames are given in
  std::vector<Gate> gates;           ///< [traversal index]
  std::vector<std::uint32_t> order;  ///< [traversal index] = vertex of `mesh`
  std::vector<std::uint8_t> levels;  ///< [traversal index]; empty where the mesh has none
  CoarseCut cut;                     ///< the coarser mesh that frames are given out for, if one is
  MeshInfo info;
  std::uint32_t id = 0;  ///< the mesh chunk's payload checksum, by which GOPs name it

  /// What frames are given out for.
  const Mesh& drawn() const { return cut.whole() ? mesh : cut.mesh; }
  /// Calls use(traversal index, vertex) for each vertex that is drawn.
  template <class Use>
  void for_each_drawn(const Use& use) const {
    const std::vector<std::uint32_t>& list = cut.whole() ? order : cut.vertices;
    for (std::uint32_t i = 0; i < list.size(); ++i) cut.whole() ? use(i, list[i]) : use(list[i], i);
  }

  /// Parts that the planes of a basis come in, and those of them that the mesh drawn needs (format-spec
  /// §7.8.1).
  std::size_t parts() const { return info.lods.size() + 1; }
  std::size_t parts_wanted() const { return parts() - info.lod; }
  /// The lowest level that is not in a part or the ones before it.
  std::uint32_t level_behind(std::size_t part) const {
    return part < info.lods.size() ? info.lods[info.lods.size() - 1 - part].levels : kMaxVertexLevels;
  }
  /// [part]: the turn of the pyramid that it ends before.
  std::array<std::size_t, kMaxCoarseMeshes + 1> part_ends() const {
    std::array<std::size_t, kMaxCoarseMeshes + 1> ends{};
    for (std::size_t part = 0; part + 1 < parts(); ++part)
      ends[part] = info.lods[info.lods.size() - 1 - part].vertices;
    ends[parts() - 1] = order.size();
    return ends;
  }
};

/// Decodes a mesh from the sections of its chunk, but for its levels and coarser meshes (format-spec §4.3).
Result<CodedMesh> decode_mesh(const MeshLayout& layout, std::uint32_t id);

/// Decodes the levels of a mesh and, of its coarser meshes, the one of this number: the first is 1, and what
/// is above the last is that; 0 for none. kMalformed, kLimitExceeded, kOutOfMemory.
Status decode_levels_of_mesh(const MeshLayout& layout, std::uint32_t lod, CodedMesh& mesh);

/// What the sections of a mesh take, and how many levels there are.
MeshInfo sizes_of(const MeshLayout& layout);
/// What a section says of coarser meshes. False without memory.
[[nodiscard]] bool list_lods(const CoarseLayouts& layouts, std::vector<LodInfo>& lods);

}  // namespace tvg
