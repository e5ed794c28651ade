#pragma once
#include "attributes/animated_attributes.hpp"
#include "connectivity/mesh_coder.hpp"
#include "container/mesh_payload.hpp"
#include "planes/reference_shape.hpp"
#include "prediction/pyramid.hpp"

#include <cstdint>
#include <optional>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A mesh as its GOPs need it, on either side.
struct GopMesh {
  CodedMesh coded;
  std::optional<Pyramid> pyramid;  ///< where the mesh has a reference shape (§5.4)
  ReferenceShape shape;            ///< which the pyramid is made of; empty where there is none
  MeshProperties properties;       ///< decoded; empty for an encoder and where a coarser mesh is drawn
  AnimatedAttributes animated;     ///< empty where a coarser mesh is drawn
};

/// Decodes a mesh from the sections of its chunk (format-spec §4.3), to be drawn as its coarser mesh of
/// number `lod`, as decode_levels_of_mesh() has it. `limits` are the stream's: kLimitExceeded where the mesh
/// has a reference shape or coarser meshes and the memory that is declared does not allow for that (§8.2).
Result<GopMesh> decode_gop_mesh(const MeshLayout& layout, std::uint32_t id, const StreamLimits& limits,
                                std::uint32_t lod = 0);

}  // namespace tvg
