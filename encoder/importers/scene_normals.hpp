#pragma once
#include "encoder/importers/normals_choice.hpp"
#include "encoder/importers/scene_mesh.hpp"

#include <span>
#include <string>
#include <vector>

namespace tvg::cli {

/// Whether the clip moves any vertex.
bool is_moved(const SceneMesh& mesh, const SceneNodes& nodes, const Clip& clip);

/// Keeps the normals of a mesh or leaves them out, and notes why. `positions` are those of the first frame,
/// finite. Normals do not follow a mesh that moves, so that kAuto keeps none of such. True where those left
/// out are of the faces, each by itself.
bool choose_normals(const Mesh& mesh, MeshProperties& properties, std::span<const float> positions,
                    bool moves, NormalsChoice choice, std::vector<std::string>& notes);

}  // namespace tvg::cli
