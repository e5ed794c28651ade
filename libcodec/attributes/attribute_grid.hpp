#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <tvg/properties.hpp>

// The integers that stand for the numbers of an attribute (format-spec §5.7.1).
namespace tvg {

/// How an attribute's numbers and integers belong together.
struct AttributeGrid {
  AttributeKind kind = AttributeKind::kGeneric;
  std::uint32_t components = 1;
  int bits = Attribute::kExact;
  std::array<float, kMaxAttributeComponents> origin{};  ///< [component]: the smallest number
  double range = 0;  ///< from the smallest to the largest, of any component

  bool octahedral() const { return kind == AttributeKind::kNormal && bits != Attribute::kExact; }
  /// Whether numbers lie on a grid that begins at `origin`.
  bool stepped() const { return bits != Attribute::kExact && !octahedral(); }
  /// Integers that a value has.
  std::size_t integers() const { return octahedral() ? 2 : components; }
  /// The largest integer of what is not exact.
  std::int32_t largest() const { return (std::int32_t{1} << bits) - (octahedral() ? 2 : 1); }
  /// Both integers of a normal that is none.
  std::int32_t none() const { return largest() + 1; }

  /// The value of these integers, which are within their range.
  void value_of(std::span<const std::int32_t> integers, std::span<float> value) const;
};

/// A binary32 number as an integer in the order of the numbers, and back (format-spec §7.9.1).
std::int32_t ordered_integer(float number);
float ordered_number(std::int32_t integer);
/// Whether an integer is that of a number that is finite.
bool is_finite_number(std::int32_t integer);
/// The finite binary32 number that is nearest.
float finite_float(double number);

/// Normals have two bits at least.
inline constexpr int kMinNormalBits = 2;

}  // namespace tvg
