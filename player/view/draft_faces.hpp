#pragma once
#include <vector>

#include <tvg/types.hpp>

namespace tvg::player {

/// Fewer faces over the same vertices, for drawing where faces are smaller than pixels and each costs time:
/// about a third on a closed mesh. Vertices are gathered to neighbours that stay, so that no cracks open;
/// [face][corner], indices below the mesh's vertex count. The positions of any frame serve.
std::vector<Face> draft_faces(const Mesh& mesh);

}  // namespace tvg::player
