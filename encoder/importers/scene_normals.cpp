#include "encoder/importers/scene_normals.hpp"

#include "encoder/importers/normal_shading.hpp"

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

bool choose_normals(const Mesh& mesh, MeshProperties& properties, std::span<const float> positions,
                    bool moves, NormalsChoice choice, std::vector<std::string>& notes) {
  if (choice == NormalsChoice::kKeep) return false;
  bool is_flat = false;
  const char* note = nullptr;
  std::erase_if(properties.attributes, [&](const Attribute& attribute) {
    if (attribute.kind != AttributeKind::kNormal) return false;
    if (choice == NormalsChoice::kDrop) return true;
    const auto shading = find_shading(mesh.faces, properties.polygons, positions, attribute);
    is_flat = shading == NormalShading::kFlat;
    if (shading == NormalShading::kSmooth) {
      note = "its normals are left out: they are what the faces give, shaded smoothly";
    } else if (is_flat) {
      note = "its normals are left out: they are those of the faces, shaded flat";
    } else if (moves) {
      note =
          "its normals are left out: they are those of one pose, and the mesh moves (--normals keep keeps "
          "them)";
    }
    return shading || moves;
  });
  if (note != nullptr) notes.emplace_back(note);
  return is_flat;
}

}  // namespace tvg::cli
