#include "connectivity/vertex_levels_encode.hpp"

#include "connectivity/vertex_levels.hpp"
#include "entropy/range_coder.hpp"

#include <algorithm>

namespace tvg {

std::vector<std::uint8_t> encode_levels(std::span<const std::uint8_t> levels, std::span<const Gate> gates) {
  std::vector<std::uint8_t> copy(levels.begin(), levels.end());
  const auto count = std::uint32_t{*std::max_element(copy.begin(), copy.end())} + 1;
  RangeEncoder coder;
  code_levels(coder, gates, count, copy);
  ByteWriter section;
  section.u8(static_cast<std::uint8_t>(count));
  section.bytes(coder.finish());
  return section.take();
}

}  // namespace tvg
