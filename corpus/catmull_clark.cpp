#include "corpus/catmull_clark.hpp"

#include <algorithm>
#include <unordered_map>

namespace tvg::corpus {
namespace {

void add(CageVertex& sum, const CageVertex& term, double weight) {
  for (std::size_t k = 0; k < kCageChannels; ++k) sum[k] += weight * term[k];
}

/// Indices of the undirected edges, in the order they are first met.
class EdgeIndex {
 public:
  std::uint32_t at(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    return index_.try_emplace(key, static_cast<std::uint32_t>(index_.size())).first->second;
  }

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
};

}  // namespace

Cage subdivide(const Cage& cage) {
  const std::size_t old_count = cage.vertices.size();
  const std::size_t edge_count = cage.quads.size() * 2;
  Cage fine;
  fine.vertices.resize(old_count + edge_count + cage.quads.size(), CageVertex{});
  const auto edge_vertex = [&](std::uint32_t edge) { return static_cast<std::uint32_t>(old_count + edge); };
  const auto face_vertex = [&](std::size_t quad) {
    return static_cast<std::uint32_t>(old_count + edge_count + quad);
  };

  // Each edge is seen from both of its quads, so half of its ends' share comes from either.
  EdgeIndex edges;
  std::vector<double> valence(old_count, 0);
  std::vector<CageVertex> ring_sum(old_count, CageVertex{});
  for (std::size_t q = 0; q < cage.quads.size(); ++q) {
    const auto& quad = cage.quads[q];
    CageVertex& face_point = fine.vertices[face_vertex(q)];
    for (const std::uint32_t v : quad) add(face_point, cage.vertices[v], 0.25);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t v = quad[k];
      const std::uint32_t next = quad[(k + 1) % 4];
      CageVertex& edge_point = fine.vertices[edge_vertex(edges.at(v, next))];
      add(edge_point, face_point, 0.25);
      add(edge_point, cage.vertices[v], 0.125);
      add(edge_point, cage.vertices[next], 0.125);
      // Per incident quad: its centre once, and one of the vertex's edges by its far end.
      add(ring_sum[v], face_point, 1);
      add(ring_sum[v], cage.vertices[next], 1);
      valence[v] += 1;
    }
  }
  for (std::size_t v = 0; v < old_count; ++v) {
    add(fine.vertices[v], ring_sum[v], 1 / (valence[v] * valence[v]));
    add(fine.vertices[v], cage.vertices[v], (valence[v] - 2) / valence[v]);
  }
  for (std::size_t q = 0; q < cage.quads.size(); ++q) {
    const auto& quad = cage.quads[q];
    for (std::size_t k = 0; k < 4; ++k) {
      fine.quads.push_back({quad[k], edge_vertex(edges.at(quad[k], quad[(k + 1) % 4])), face_vertex(q),
                            edge_vertex(edges.at(quad[(k + 3) % 4], quad[k]))});
    }
  }
  return fine;
}

}  // namespace tvg::corpus
