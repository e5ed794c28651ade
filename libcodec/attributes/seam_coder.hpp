#pragma once
#include "attributes/edge_pairs.hpp"
#include "attributes/property_mesh.hpp"
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
  SeamCoder(const PropertyMesh& mesh, std::span<const std::uint32_t> partner)
      : mesh_(mesh), partner_(partner), earlier_(partner.size()), left_(mesh.vertex_count()), met_(mesh.vertex_count()) {}

  template <class Coder>
  bool code(Coder& coder, std::span<std::uint8_t> seams) {
    std::fill(left_.begin(), left_.end(), 0u);
    std::fill(met_.begin(), met_.end(), std::uint8_t{0});
    for (std::uint32_t h = 0; h < seams.size(); ++h) {
      if (is_first(h)) continue;
      ++left_[start(h)];
      ++left_[start(next_corner(h))];
    }
    std::vector<AdaptiveSymbol> fine(3 * 36, AdaptiveSymbol(2)), coarse(3 * 5 * 3, AdaptiveSymbol(2));
    for (std::uint32_t h = 0; h < seams.size(); ++h) {
      if (is_first(h)) continue;
      const std::uint32_t back = partner_[h], a = start(h), b = start(next_corner(h));
      const std::size_t before = !again_ ? 0 : earlier_[h] == 0 ? 1 : 2;
      const std::size_t ends = std::min(end(a), end(b)) * 6 + std::max(end(a), end(b));
      const std::size_t both = std::min<std::size_t>(met_[a] + met_[b], 2);
      const bool seam = coder.code(fine[before * 36 + ends], coarse[(before * 5 + bend(h)) * 3 + both], seams[h] != 0 ? 1 : 0) != 0;
      seams[h] = seams[back] = seam ? 1 : 0;
      for (const std::uint32_t v : {a, b}) {
        --left_[v];
        if (seam && met_[v] < 2) ++met_[v];
      }
      if (seam) earlier_[h] = 1;
      if constexpr (Coder::kDecoding) {
        if (coder.overrun()) return false;
      }
    }
    again_ = true;
    return true;
  }

 private:
  std::uint32_t start(std::uint32_t h) const { return mesh_.faces[h / 3][h % 3]; }
  /// Of the two half-edges of an edge the first does not tell; nor does one that is alone.
  bool is_first(std::uint32_t h) const { return partner_[h] == kNoCorner || partner_[h] > h; }
  std::size_t end(std::uint32_t v) const { return met_[v] * 2u + (left_[v] == 1 ? 1u : 0u); }

  using Vector = std::array<double, 3>;
  Vector normal(std::uint32_t face) const {
    const auto& f = mesh_.faces[face];
    const auto &p = mesh_.shape->indices[f[0]], &q = mesh_.shape->indices[f[1]], &r = mesh_.shape->indices[f[2]];
    const Vector a = {static_cast<double>(q[0] - p[0]), static_cast<double>(q[1] - p[1]), static_cast<double>(q[2] - p[2])};
    const Vector b = {static_cast<double>(r[0] - p[0]), static_cast<double>(r[1] - p[1]), static_cast<double>(r[2] - p[2])};
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  std::size_t bend(std::uint32_t h) const {
    if (mesh_.shape == nullptr) return 4;
    const Vector a = normal(h / 3), b = normal(partner_[h] / 3);
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const double size = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * std::sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    return dot > 0.97 * size ? 0 : dot > 0.8 * size ? 1 : dot > 0.4 * size ? 2 : 3;
  }

  const PropertyMesh& mesh_;
  std::span<const std::uint32_t> partner_;
  std::vector<std::uint8_t> earlier_;
  std::vector<std::uint32_t> left_;
  std::vector<std::uint8_t> met_;
  bool again_ = false;
};

}  // namespace tvg
