#include "basis/basis_header.hpp"

#include <algorithm>
#include <cmath>

namespace tvg {

void write_basis_header(ByteWriter& writer, const BasisHeader& header) {
  writer.varint(header.components);
  writer.u8(static_cast<std::uint8_t>(header.fine_bits));
  writer.u8(static_cast<std::uint8_t>(header.coarse_bits));
  writer.u8(static_cast<std::uint8_t>(header.fraction_bits));
  for (const double coordinate : header.origin) writer.f64(coordinate);
  writer.f64(header.step);
  writer.bytes(header.scales);
  writer.varint(header.flags.size());
  writer.bytes(header.flags);
}

// format-spec §7.8.1
Fault read_basis_header(ByteReader& reader, const StreamLimits& limits, BasisHeader& header) {
  constexpr const char* kSection = "§7.8.1";
  constexpr Fault kShort{kSection, "the plan of a basis is too short"};
  const std::uint64_t components = reader.varint();
  header.fine_bits = reader.u8();
  header.coarse_bits = reader.u8();
  header.fraction_bits = reader.u8();
  for (double& coordinate : header.origin) coordinate = reader.f64();
  header.step = reader.f64();
  if (!reader.ok()) return kShort;
  if (components > limits.components)
    return {"§4.1", "a basis has more components than the head declares", ErrorCode::kLimitExceeded};
  header.components = static_cast<std::uint32_t>(components);
  if (header.coarse_bits < kMinBits || header.coarse_bits > header.fine_bits || header.fine_bits > kMaxBits ||
      header.fraction_bits > BasisHeader::kMostFractionBits)
    return {kSection, "the bits of a basis are out of range"};
  const bool finite =
      std::all_of(header.origin.begin(), header.origin.end(), [](double x) { return std::isfinite(x); });
  if (!finite || !std::isfinite(header.step) || header.step <= 0)
    return {kSection, "a basis has no finite origin or no positive step"};
  header.scales = reader.bytes(components + 1);
  header.flags = reader.bytes(reader.varint());
  if (!reader.ok()) return kShort;
  if (std::any_of(header.scales.begin(), header.scales.end(), [](auto z) { return z > RowScale::kMost; }))
    return {kSection, "the scale of a row is out of range"};
  if (header.nested_bits() == 0 && !header.flags.empty())
    return {kSection, "a basis with one lattice carries flags"};
  return {};
}

}  // namespace tvg
