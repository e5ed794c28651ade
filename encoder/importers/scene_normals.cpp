#include "encoder/importers/scene_normals.hpp"

#include <algorithm>

namespace tvg::cli {

bool is_moved(const SceneMesh& mesh, const SceneNodes& nodes, const Clip& clip) {
  if (!(clip.duration() > 0)) return false;
  if (mesh.slot_count > 0) return true;
  std::vector<char> moves(nodes.list().size(), 0);
  for (const NodeChannel& channel : clip.nodes) moves[channel.node] = 1;
  for (std::size_t node = 0; node < moves.size(); ++node) {
    const std::int32_t parent = nodes.list()[node].parent;
    if (parent >= 0) moves[node] |= moves[static_cast<std::size_t>(parent)];
  }
  return std::any_of(mesh.carriers.begin(), mesh.carriers.end(),
                     [&moves](const Carrier& carrier) { return moves[carrier.node] != 0; });
}

void choose_normals(const Mesh& mesh, MeshProperties& properties, std::span<const float> positions,
                    bool moves, NormalsChoice choice, std::vector<std::string>& notes) {
  if (choice == NormalsChoice::kKeep) return;
  bool any_lost = false;
  std::erase_if(properties.attributes, [&](const Attribute& attribute) {
    if (attribute.kind != AttributeKind::kNormal) return false;
    if (choice == NormalsChoice::kDrop || follow_from_faces(mesh, positions, attribute)) return true;
    any_lost = any_lost || moves;
    return moves;
  });
  if (any_lost) {
    notes.emplace_back(
        "its normals are left to the player, since the mesh moves: hard edges become smooth. `--normals "
        "keep` keeps those of the first frame");
  }
}

}  // namespace tvg::cli
