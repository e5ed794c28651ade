#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tvg {

/// Checksum of a structure's bytes (format-spec §2.3): the low 32 bits of XXH64 with the given seed.
std::uint32_t checksum(std::span<const std::uint8_t> bytes, std::uint64_t seed = 0);

/// XXH64 with seed 0 over bytes that arrive in pieces.
class Hasher {
 public:
  Hasher();
  void update(std::span<const std::uint8_t> bytes);
  /// Each integer counts as its four bytes, least significant first.
  void update(std::span<const std::int32_t> values);
  std::uint64_t value() const;

 private:
  alignas(8) std::array<std::byte, 88> state_;
};

}  // namespace tvg
