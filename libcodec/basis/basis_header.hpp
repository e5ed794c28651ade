#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// What a row's integers are multiplied by: (4 + the low two bits) times two to the others (format-spec
/// §7.8.1).
struct RowScale {
  static constexpr std::uint8_t kMost = 4 * 40 + 3;

  std::uint8_t code = 0;

  constexpr std::int64_t factor() const { return std::int64_t{4 + (code & 3)} << (code >> 2); }
};

/// A plan's fields in mode basis, in front of the planes (format-spec §7.8.1).
struct BasisHeader {
  static constexpr int kMostFractionBits = 48;

  std::uint32_t components = 0;
  int fine_bits = 11;     ///< B2: the lattice whose error the important vertices have
  int coarse_bits = 11;   ///< B1 <= B2: that of the others
  int fraction_bits = 0;  ///< sums are in 2^-fraction_bits of a step
  std::array<double, 3> origin{};
  double step = 1;  ///< of coefficients of important vertices, in the mesh's units
  Bytes scales;     ///< [row]: that of the mean position, then those of the components
  Bytes flags;      ///< coded flags (§7.4); empty where the bits are equal

  int nested_bits() const { return fine_bits - coarse_bits; }
  RowScale scale(std::size_t row) const { return {scales[row]}; }
};

void write_basis_header(ByteWriter& writer, const BasisHeader& header);
/// Reads it into `header`, which then refers to the reader's bytes.
Fault read_basis_header(ByteReader& reader, const StreamLimits& limits, BasisHeader& header);

}  // namespace tvg
