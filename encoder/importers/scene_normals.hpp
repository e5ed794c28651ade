#pragma once
#include "encoder/importers/normals_choice.hpp"
#include "encoder/importers/scene_mesh.hpp"

#include <span>
#include <string>
#include <vector>

namespace tvg::cli {

/// Whether the clip moves any vertex.
bool is_moved(const SceneMesh& mesh, const SceneNodes& nodes, const Clip& clip);

/// Keeps the normals of a mesh or leaves them out. `positions` are those of the first frame, finite.
/// Normals do not follow a mesh that moves, so that kAuto keeps none of such. Notes what a player does not
/// find by itself.
void choose_normals(const Mesh& mesh, MeshProperties& properties, std::span<const float> positions,
                    bool moves, NormalsChoice choice, std::vector<std::string>& notes);

}  // namespace tvg::cli
