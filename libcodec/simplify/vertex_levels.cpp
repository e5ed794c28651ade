#include "simplify/vertex_levels.hpp"

#include <algorithm>
#include <vector>

namespace tvg {
namespace {

/// So many vertices after one another in the order of removal have one level.
struct Step {
  std::uint32_t removed = 0;
  bool kept_after = false;  ///< a mesh was kept then, so that the level has to end
};

/// Joins the two neighbours that together removed least and between which no mesh was kept. There are some:
/// fewer meshes are kept than there may be levels.
void join_smallest(std::vector<Step>& steps) {
  std::size_t best = steps.size();
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (steps[i].kept_after) continue;
    if (best == steps.size() ||
        steps[i].removed + steps[i + 1].removed < steps[best].removed + steps[best + 1].removed) {
      best = i;
    }
  }
  steps[best + 1].removed += steps[best].removed;
  steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(best));
}

CoarseMesh coarse_mesh(const SimplifiedMesh& mesh, std::size_t levels) {
  CoarseMesh result{static_cast<std::uint32_t>(levels), {}};
  for (const Face& face : mesh.mesh.faces) {
    result.faces.push_back({mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]});
  }
  return result;
}

}  // namespace

MeshLevels vertex_levels(std::uint32_t vertex_count, const LevelsOfRemoval& run) {
  std::vector<Step> steps;
  for (const SimplifyLevel& level : run.levels) steps.push_back({level.removed, false});
  for (const LevelsOfRemoval::Kept& kept : run.kept) {
    if (kept.levels > 0) steps[kept.levels - 1].kept_after = true;
  }
  while (steps.size() >= kMaxVertexLevels) join_smallest(steps);

  MeshLevels result;
  result.level.assign(vertex_count, 0);
  auto next = run.removed.begin();
  std::size_t level = steps.size();
  std::vector<std::size_t> levels_at;  // of the meshes that were kept, each once
  for (const Step& step : steps) {
    for (std::uint32_t i = 0; i < step.removed; ++i) result.level[*next++] = static_cast<std::uint8_t>(level);
    if (step.kept_after) levels_at.push_back(level);
    --level;
  }
  auto at = levels_at.begin();
  std::size_t done = 0;
  for (const LevelsOfRemoval::Kept& kept : run.kept) {
    if (kept.levels == done) continue;
    done = kept.levels;
    result.coarse.push_back(coarse_mesh(kept.mesh, *at++));
  }
  return result;
}

}  // namespace tvg
