#pragma once
#include "planes/lanes.hpp"
#include "quantization/lattice.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tvg {

/// Positions of a lattice's cells: what reconstruct() gives for each axis, for all axes at once where no
/// clamping can be needed and the compiler has a type for it.
class CellCentres {
 public:
  /// Cells of this edge, up to 2^`bits` along each axis.
  CellCentres(const std::array<double, 3>& origin, double step, int bits)
      : origin_{origin[0], origin[1], origin[2], 0}, step_(step) {
    constexpr double kFar = std::numeric_limits<float>::max() / 2;
    for (const double start : origin) near_ = near_ && std::abs(start) + std::ldexp(step, bits) < kFar;
  }

  /// Puts the position of a cell at `target`: three float32, aligned or not.
  void put(const Quad& index, std::byte* target) const {
#if defined(__GNUC__) && !defined(TVG_PLAIN_LANES)
    if (near_) [[likely]] {
      using Indices [[gnu::vector_size(4 * sizeof(std::int32_t))]] = std::int32_t;
      using Coordinates [[gnu::vector_size(4 * sizeof(double))]] = double;
      using Rounded [[gnu::vector_size(4 * sizeof(float))]] = float;
      Indices indices;
      Coordinates origin;
      std::memcpy(&indices, &index, sizeof indices);
      std::memcpy(&origin, &origin_, sizeof origin);
      const Coordinates centre = origin + (__builtin_convertvector(indices, Coordinates) + 0.5) * step_;
      const Rounded rounded = __builtin_convertvector(centre, Rounded);
      for (std::size_t axis = 0; axis < 3; ++axis) put(rounded[axis], axis, target);
      return;
    }
#endif
    for (std::size_t axis = 0; axis < 3; ++axis)
      put(reconstruct(index[axis], origin_[axis], step_), axis, target);
  }

 private:
  static void put(float coordinate, std::size_t axis, std::byte* target) {
    std::memcpy(target + axis * sizeof coordinate, &coordinate, sizeof coordinate);
  }

  std::array<double, 4> origin_;
  double step_;
  bool near_ = true;
};

}  // namespace tvg
