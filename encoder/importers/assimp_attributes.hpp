#pragma once
#include "encoder/importers/scene_reader.hpp"

struct aiMesh;

namespace tvg::cli {

/// Adds the texture coordinates, normals and colours of a mesh to a part that has its positions, under the
/// names that glTF has for them. One with numbers that are not finite is left out with a note.
void read_assimp_attributes(const aiMesh& mesh, ScenePart& part);

}  // namespace tvg::cli
