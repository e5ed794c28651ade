#include "simplify/subdivision.hpp"

#include "geometry/half_edges_encode.hpp"

#include <algorithm>
#include <limits>

namespace tvg {

Subdivision::Subdivision(const Mesh& base) : vertex_count_(base.vertex_count) {
  for (std::uint32_t f = 0; f < base.faces.size(); ++f) {
    Piece& piece = pieces_.emplace_back();
    piece.face = f;
    for (std::size_t c = 0; c < 3; ++c) {
      piece.corners[c].vertex = base.faces[f][c];
      piece.corners[c].weights[c] = 1;
    }
  }
  number_edges();
}

Face Subdivision::face(std::size_t face) const {
  const auto& [a, b, c] = pieces_[face].corners;
  return {a.vertex, b.vertex, c.vertex};
}

Mesh Subdivision::mesh() const {
  Mesh result{vertex_count_, {}};
  for (std::size_t f = 0; f < pieces_.size(); ++f) result.faces.push_back(face(f));
  return result;
}

void Subdivision::number_edges() {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  const std::vector<HalfEdge> sorted = half_edges_by_edge(mesh());
  std::vector<std::uint32_t> first(3 * pieces_.size());  // [half-edge] the first of its edge
  for (std::size_t i = 0, begin = 0; i < sorted.size(); ++i) {
    if (!sorted[i].same_edge(sorted[begin])) begin = i;
    first[sorted[i].id] = sorted[begin].id;
  }
  std::vector<std::uint32_t> number(first.size(), kNone);
  edges_.clear();
  edges_of_.assign(pieces_.size(), {});
  for (std::uint32_t h = 0; h < first.size(); ++h) {
    const Piece& piece = pieces_[h / 3];
    if (number[first[h]] == kNone) {
      number[first[h]] = static_cast<std::uint32_t>(edges_.size());
      edges_.emplace_back(piece.corners[h % 3].vertex, piece.corners[(h + 1) % 3].vertex);
    }
    edges_of_[h / 3][h % 3] = number[first[h]];
  }
}

Subdivision::Weights Subdivision::between(const Corner& a, const Corner& b) {
  Weights weights;
  for (std::size_t c = 0; c < 3; ++c) weights[c] = (a.weights[c] + b.weights[c]) / 2;
  return weights;
}

std::vector<SurfacePlace> Subdivision::middles_of_edges() const {
  std::vector<SurfacePlace> middles(edges_.size());
  for (std::size_t f = pieces_.size(); f-- > 0;) {  // the first face that has an edge has the last word
    for (std::size_t c = 0; c < 3; ++c) {
      middles[edges_of_[f][c]] = {pieces_[f].face,
                                  between(pieces_[f].corners[c], pieces_[f].corners[(c + 1) % 3])};
    }
  }
  return middles;
}

std::vector<SurfacePlace> Subdivision::middles_of_faces() const {
  std::vector<SurfacePlace> middles;
  for (const Piece& piece : pieces_) {
    SurfacePlace& middle = middles.emplace_back();
    middle.face = piece.face;
    for (const Corner& corner : piece.corners) {
      for (std::size_t c = 0; c < 3; ++c) middle.weights[c] += corner.weights[c] / 3;
    }
  }
  return middles;
}

void Subdivision::cut(std::span<const std::uint8_t> marks) {
  std::vector<std::uint32_t> middle(marks.size());
  for (std::size_t e = 0; e < marks.size(); ++e) {
    if (marks[e] != 0) middle[e] = vertex_count_++;
  }
  std::vector<Piece> pieces;
  for (std::size_t f = 0; f < pieces_.size(); ++f) {
    const std::array<std::uint32_t, 3>& edges = edges_of_[f];
    const auto marked = [&](std::size_t side) { return marks[edges[side % 3]] != 0; };
    const auto count =
        static_cast<int>(marked(0)) + static_cast<int>(marked(1)) + static_cast<int>(marked(2));
    // Turned so that one marked side is the first, and of two the other is the second.
    std::size_t turn = 0;
    while (count == 1 && !marked(turn)) ++turn;
    while (count == 2 && marked(turn + 2)) ++turn;
    const auto at = [&](std::size_t c) { return pieces_[f].corners[(turn + c) % 3]; };
    const auto on = [&](std::size_t side) {
      return Corner{middle[edges[(turn + side) % 3]], between(at(side), at(side + 1))};
    };
    const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
      pieces.push_back({pieces_[f].face, {a, b, c}});
    };
    if (count == 0) add(at(0), at(1), at(2));
    if (count == 1) add(at(0), on(0), at(2)), add(on(0), at(1), at(2));
    if (count == 2) add(on(0), at(1), on(1)), add(at(0), on(0), on(1)), add(at(0), on(1), at(2));
    if (count == 3) {
      for (std::size_t c = 0; c < 3; ++c) add(at(c), on(c), on(c + 2));
      add(on(0), on(1), on(2));
    }
  }
  pieces_ = std::move(pieces);
  number_edges();
}

}  // namespace tvg
