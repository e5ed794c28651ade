#pragma once
#include <span>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// What becomes of the normals of an input.
enum class NormalsChoice {
  kAuto,  ///< kept, but where a player finds them by itself
  kKeep,
  kDrop,
};

/// Whether `normals`, of vertices or corners, are no more than what vertex_normals() makes of `positions`
/// ([vertex][xyz], finite): none is off by more than one degree. A normal without a length fits any.
bool follow_from_faces(const Mesh& mesh, std::span<const float> positions, const Attribute& normals);

}  // namespace tvg::cli
