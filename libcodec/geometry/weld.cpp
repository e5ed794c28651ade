#include <array>
#include <bit>

#include <tvg/geometry.hpp>

namespace tvg {

Weld weld_positions(std::span<const float> positions) {
  const auto bits_of = [positions](std::uint32_t point) {
    const std::size_t x = 3 * std::size_t{point};
    return std::array{std::bit_cast<std::uint32_t>(positions[x]),
                      std::bit_cast<std::uint32_t>(positions[x + 1]),
                      std::bit_cast<std::uint32_t>(positions[x + 2])};
  };
  const auto hash = [&](std::uint32_t point) {
    std::uint64_t mixed = 0;
    for (const std::uint32_t word : bits_of(point)) mixed = mix_hash(mixed, word);
    return mixed;
  };
  return weld_points(positions.size() / 3, hash,
                     [&](std::uint32_t a, std::uint32_t b) { return bits_of(a) == bits_of(b); });
}

}  // namespace tvg
