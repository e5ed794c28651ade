#pragma once
#include "encoder/importers/scene_reader.hpp"

struct aiMesh;
struct aiFace;
struct aiScene;

namespace tvg::cli {

/// Whether all polygons are such that a fan around one of their corners fills them.
bool are_fans(const aiScene& scene);

/// Adds the faces of a mesh, polygons as fans; those of fewer than three corners are counted as left out.
/// Corners are as the file has them.
void read_assimp_faces(const aiMesh& mesh, ScenePart& part);

}  // namespace tvg::cli
