#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tvg/simplify.hpp>

namespace tvg {

/// A mesh whose faces are cut up at the middles of edges, each piece within the face it came from.
class Subdivision {
 public:
  explicit Subdivision(const Mesh& base);

  Mesh mesh() const;
  Face face(std::size_t face) const;
  /// [edge] its ends. Edges are numbered as the faces name them first.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges() const { return edges_; }
  /// [corner] The edge from there to the next corner.
  const std::array<std::uint32_t, 3>& edges_of(std::size_t face) const { return edges_of_[face]; }
  /// [edge], [face] The middles, in a face of the base that has them.
  std::vector<SurfacePlace> middles_of_edges() const;
  std::vector<SurfacePlace> middles_of_faces() const;

  /// Puts a new vertex on each edge that is marked, [edge], in the order of the edges, and cuts the faces
  /// that have it into two, three or four. Every face beside an edge sees the same mark, so none gets a
  /// vertex on a side of it.
  void cut(std::span<const std::uint8_t> marks);

 private:
  using Weights = std::array<double, 3>;
  struct Corner {
    std::uint32_t vertex = 0;
    Weights weights{};  ///< in the face of the base
  };
  struct Piece {
    std::uint32_t face = 0;  ///< of the base
    std::array<Corner, 3> corners;
  };

  void number_edges();
  static Weights between(const Corner& a, const Corner& b);

  std::uint32_t vertex_count_;
  std::vector<Piece> pieces_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
  std::vector<std::array<std::uint32_t, 3>> edges_of_;
};

}  // namespace tvg
