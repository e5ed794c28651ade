#include "quantization/lattice_over_encode.hpp"

#include "base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace tvg {

namespace {

/// The last multiple of `edge` that is not above `low`; `low` itself where binary64 has none, because the
/// grid is too fine there or goes on beyond its range.
double grid_line_below(double low, double edge) {
  const double number = std::floor(low / edge);
  const double line = number * edge <= low ? number * edge : (number - 1) * edge;
  return std::abs(number) < 0x1p53 && std::isfinite(line) ? line : low;
}

Error step_too_small(double bits, double extent, int coarser) {
  const std::string needed = bits > 999 ? "more than 999" : std::to_string(static_cast<int>(bits));
  // The box may begin anywhere in its first coarse cell. Rounded up to the three digits that are told.
  const double enough = extent / (std::ldexp(1, kMaxBits) - std::ldexp(1, coarser)) * 1.01;
  char told[32];
  std::snprintf(told, sizeof told, "%.3g", enough);
  return invalid_argument("the step is too small: the box would need " + needed + " bits where " +
                          std::to_string(kMaxBits) + " are possible, or a step of at least " + told);
}

Result<Lattice> lattice_on_grid(const BoundingBox& box, int coarser, double step) {
  Lattice lattice;
  lattice.step = step;
  double last_cell = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lattice.origin[axis] = grid_line_below(box.low()[axis], std::ldexp(step, coarser));
    last_cell = std::max(last_cell, std::floor((box.high()[axis] - lattice.origin[axis]) / step));
  }
  const double bits = last_cell < 1 ? kMinBits : std::floor(std::log2(last_cell)) + 1;
  if (bits > kMaxBits) return step_too_small(bits, box.largest_extent(), coarser);
  lattice.fine_bits = std::max(static_cast<int>(bits), kMinBits + coarser);
  lattice.coarse_bits = lattice.fine_bits - coarser;
  return lattice;
}

}  // namespace

Result<Lattice> lattice_over(const BoundingBox& box, int fine_bits, int coarse_bits,
                             std::optional<double> step) {
  if (step) return lattice_on_grid(box, fine_bits - coarse_bits, *step);
  Lattice lattice{box.low(), std::ldexp(box.largest_extent(), -fine_bits), fine_bits, coarse_bits};
  // All in one point, as far as binary64 can tell: any small cell will do.
  if (!(lattice.step > 0)) lattice.step = std::max(1.0, std::abs(box.low()[0])) * 0x1p-24;
  return lattice;
}

}  // namespace tvg
