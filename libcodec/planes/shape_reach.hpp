#pragma once
#include "planes/lanes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace tvg {

/// Sums over the parallelograms that a vertex closes, of which there are ends[3] / 2.
struct WingSums {
  Quad ends;    ///< of a + b
  Quad across;  ///< of o
};

/// Learns how far beyond the edges a vertex lies: at M + c (M - O), M the mean of the edges' middles and O
/// that of the vertices across (format-spec §5.3.5). A parallelogram has c = 1; a rough surface is best
/// predicted with less, the more so the more parallelograms there are. A regression that weighs each vertex
/// by its error's inverse, so that single spikes do not rule it.
class ShapeReach {
 public:
  /// For a lattice of so many bits.
  explicit ShapeReach(int bits) : shift_(std::max(0, bits - 12)) {}

  /// The sum of predictions in the quarters of lattice steps: four times as many as there are
  /// parallelograms.
  Quad predict(const WingSums& sums) const {
    const std::int64_t reach = classes_[class_of(sums)].reach;
    Quad result{0, 0, 0, 4 * sums.across[3]};
    for (std::size_t k = 0; k < 3; ++k)
      result[k] = static_cast<std::int32_t>((sums.ends[k] * (256 + reach) - 2 * reach * sums.across[k]) >> 7);
    return result;
  }

  /// Learns from where the vertex was.
  void learn(const WingSums& sums, const Quad& position) {
    Class& c = classes_[class_of(sums)];
    const std::int32_t twice = 2 * sums.across[3];
    std::int64_t product = 0, square = 0, error = twice;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t over = (sums.ends[k] - 2 * std::int64_t{sums.across[k]}) >> shift_;
      const std::int64_t wanted = (std::int64_t{twice} * position[k] - sums.ends[k]) >> shift_;
      product += over * wanted;
      square += over * over;
      error += std::abs(wanted - ((over * c.reach) >> 8));
    }
    const std::int64_t weight = (1 << 20) / error;
    c.product += ((product * weight) >> 16) - (c.product >> 7);
    c.square = std::max<std::int64_t>(c.square + ((square * weight) >> 16) - (c.square >> 7), 256);
    c.reach = std::clamp<std::int64_t>(256 * c.product / c.square, 0, 384);
  }

 private:
  /// What is known of vertices with so many parallelograms.
  struct Class {
    std::int64_t product = 1 << 14, square = 1 << 14;
    std::int64_t reach = 256;  ///< c in 1/256
  };

  std::size_t class_of(const WingSums& sums) const {
    return std::min<std::size_t>(static_cast<std::size_t>(sums.across[3]), classes_.size()) - 1;
  }

  int shift_;  ///< keeps products within 64 bits
  std::array<Class, 8> classes_;
};

}  // namespace tvg
