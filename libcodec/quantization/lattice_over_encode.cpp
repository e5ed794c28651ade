#include "quantization/lattice_over_encode.hpp"

#include "base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace tvg {

Result<Lattice> lattice_over(const BoundingBox& box, int fine_bits, int coarse_bits,
                             std::optional<double> step) {
  Lattice lattice{box.low(), 1.0, fine_bits, coarse_bits};
  const double extent = box.largest_extent();
  if (step) {
    lattice.step = *step;
    const double bits = std::max(1.0, std::ceil(std::log2(extent / *step)));
    if (bits > kMaxBits) {
      return invalid_argument(
          "the step is too small for this mesh: its box would need " +
          (bits > 999 ? std::string("more than 999") : std::to_string(static_cast<int>(bits))) + " bits, " +
          std::to_string(kMaxBits) + " are possible");
    }
    const int coarser = fine_bits - coarse_bits;
    lattice.fine_bits = std::max(static_cast<int>(bits), kMinBits + coarser);
    lattice.coarse_bits = lattice.fine_bits - coarser;
  } else if (extent > 0) {
    lattice.step = extent / static_cast<double>(std::int64_t{1} << fine_bits);
  } else {
    lattice.step =
        std::max(1.0, std::abs(box.low()[0])) * 0x1p-24;  // all in one point: any small cell will do
  }
  return lattice;
}

}  // namespace tvg
