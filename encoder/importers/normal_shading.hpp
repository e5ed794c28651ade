#pragma once
#include <optional>
#include <span>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// How a surface is shaded by normals that its faces give.
enum class NormalShading {
  kSmooth,  ///< at each vertex by the faces around it
  kFlat,    ///< on each face by itself, a polygon being one
};

/// How `normals`, of vertices or corners, follow from the faces, where none is off by more than one degree:
/// the faces around a vertex may count by their areas or by their angles. Nothing where they say more than
/// the faces do. `positions`: [vertex][xyz].
std::optional<NormalShading> find_shading(std::span<const Face> faces, std::span<const Polygon> polygons,
                                          std::span<const float> positions, const Attribute& normals);

}  // namespace tvg::cli
