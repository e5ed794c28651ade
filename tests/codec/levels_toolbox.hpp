#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <tvg/levels.hpp>

// Levels of vertices for tests, made without a look at geometry: the same on every machine.
namespace tvg::test {

/// Removes sets of vertices of which no two share an edge, `rounds` times or until none is left to spare:
/// each vertex goes into one that stays, and its faces with it. After each of the rounds that `kept` names,
/// counted from 1 and ascending, what is left becomes a coarser mesh.
inline std::shared_ptr<const MeshLevels> greedy_levels(const Mesh& mesh, std::uint32_t rounds,
                                                       const std::vector<std::uint32_t>& kept = {}) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<Face> faces = mesh.faces;
  std::vector<std::uint32_t> removed_in(mesh.vertex_count, kNone);
  std::vector<std::pair<std::uint32_t, std::vector<Face>>> meshes;  // after so many rounds
  std::uint32_t round = 0;
  for (; round < rounds; ++round) {
    std::vector<std::vector<std::uint32_t>> around(mesh.vertex_count);
    for (const Face& face : faces) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (face[i] == face[(i + 1) % 3]) continue;
        around[face[i]].push_back(face[(i + 1) % 3]);
        around[face[(i + 1) % 3]].push_back(face[i]);
      }
    }
    std::vector<std::uint32_t> goes_to(mesh.vertex_count);
    std::vector<bool> fixed(mesh.vertex_count);
    bool any = false;
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
      goes_to[v] = v;
    }
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
      if (removed_in[v] != kNone || fixed[v] || around[v].empty()) continue;
      removed_in[v] = round;
      goes_to[v] = *std::min_element(around[v].begin(), around[v].end());
      for (const std::uint32_t u : around[v]) fixed[u] = true;
      any = true;
    }
    if (!any) break;
    std::vector<Face> left;
    for (Face face : faces) {
      for (std::uint32_t& corner : face) corner = goes_to[corner];
      if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) left.push_back(face);
    }
    faces = std::move(left);
    if (std::find(kept.begin(), kept.end(), round + 1) != kept.end()) meshes.emplace_back(round + 1, faces);
  }
  auto levels = std::make_shared<MeshLevels>();
  for (const std::uint32_t r : removed_in)
    levels->level.push_back(r == kNone ? std::uint8_t{0} : static_cast<std::uint8_t>(round - r));
  for (auto& [after, coarse] : meshes) levels->coarse.push_back({round + 1 - after, std::move(coarse)});
  return levels;
}

}  // namespace tvg::test
