#pragma once
#include "attributes/edge_pairs.hpp"
#include "attributes/surface_vectors.hpp"
#include "entropy/adaptive_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Codes which edges are seams of an attribute (format-spec §5.7.2).
class SeamCoder {
 public:
  /// `partner` is what pair_edges() gives; it and the mesh outlive this.
  SeamCoder(const PropertyMesh& mesh, std::span<const std::uint32_t> partner)
      : mesh_(mesh),
        partner_(partner),
        earlier_(partner.size()),
        left_(mesh.vertex_count()),
        met_(mesh.vertex_count()) {}

  /// The seams of the next attribute: [half-edge], 1 for both half-edges of a seam, else 0. False where the
  /// stream ends too early.
  template <class Coder>
  bool code(Coder& coder, std::span<std::uint8_t> seams) {
    count_edges();
    std::vector<AdaptiveSymbol> by_ends(3 * 36, AdaptiveSymbol(2)), by_bend(3 * 5 * 3, AdaptiveSymbol(2));
    for (std::uint32_t h = 0; h < seams.size(); ++h) {
      if (!is_second(h)) continue;
      const std::uint32_t a = start(h), b = start(next_corner(h));
      const std::size_t before = !again_ ? 0 : earlier_[h] == 0 ? 1 : 2;
      const std::size_t ends = 6 * std::min(end(a), end(b)) + std::max(end(a), end(b));
      const auto met = static_cast<std::size_t>(std::min(met_[a] + met_[b], 2));
      const std::uint32_t seam =
          coder.code(by_ends[36 * before + ends], by_bend[3 * (5 * before + bend(h)) + met],
                     Coder::kDecoding ? 0 : seams[h]);
      if (seam > 1) return false;
      seams[h] = seams[partner_[h]] = static_cast<std::uint8_t>(seam);
      earlier_[h] = static_cast<std::uint8_t>(earlier_[h] | seam);
      for (const std::uint32_t v : {a, b}) {
        --left_[v];
        met_[v] = static_cast<std::uint8_t>(std::min<std::uint32_t>(met_[v] + seam, 2));
      }
      if constexpr (Coder::kDecoding) {
        if (coder.overrun()) return false;
      }
    }
    again_ = true;
    return true;
  }

 private:
  std::uint32_t start(std::uint32_t half_edge) const { return mesh_.faces[half_edge / 3][half_edge % 3]; }
  /// An edge is coded at the second of its half-edges.
  bool is_second(std::uint32_t h) const { return partner_[h] != kNoCorner && partner_[h] < h; }
  /// Seams met at a vertex, and whether one edge only is left there.
  std::size_t end(std::uint32_t v) const { return 2u * met_[v] + (left_[v] == 1 ? 1u : 0u); }

  void count_edges() {
    std::fill(left_.begin(), left_.end(), 0u);
    std::fill(met_.begin(), met_.end(), std::uint8_t{0});
    for (std::uint32_t h = 0; h < partner_.size(); ++h) {
      if (!is_second(h)) continue;
      ++left_[start(h)];
      ++left_[start(next_corner(h))];
    }
  }

  Vector normal(std::uint32_t face) const {
    const Vector here = place_of(mesh_, 3 * face);
    return cross(minus(place_of(mesh_, 3 * face + 1), here), minus(place_of(mesh_, 3 * face + 2), here));
  }

  /// How sharply the shape is bent at an edge: 0 to 3, or 4 where there is no shape.
  std::size_t bend(std::uint32_t h) const {
    if (mesh_.shape == nullptr) return 4;
    const Vector a = normal(h / 3), b = normal(partner_[h] / 3);
    const double cosine = dot(a, b), size = std::sqrt(dot(a, a)) * std::sqrt(dot(b, b));
    return cosine > 0.97 * size ? 0 : cosine > 0.8 * size ? 1 : cosine > 0.4 * size ? 2 : 3;
  }

  const PropertyMesh& mesh_;
  std::span<const std::uint32_t> partner_;
  std::vector<std::uint8_t> earlier_;  ///< [half-edge]: an attribute before had a seam here
  std::vector<std::uint32_t> left_;    ///< [vertex]: edges that are not coded yet
  std::vector<std::uint8_t> met_;      ///< [vertex]: seams so far, up to 2
  bool again_ = false;                 ///< there was an attribute before
};

}  // namespace tvg
