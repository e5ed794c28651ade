#include "base/allocation.hpp"
#include "connectivity/vertex_levels.hpp"
#include "entropy/range_coder.hpp"

namespace tvg {

// format-spec §5.5
Fault decode_levels(Bytes section, std::span<const Gate> gates, std::vector<std::uint8_t>& levels) {
  constexpr const char* kSection = "§5.5";
  ByteReader reader(section);
  const std::uint32_t count = reader.u8();
  if (count == 0 || count > kMaxVertexLevels)
    return {kSection, "the number of the vertices' levels is out of range"};
  if (!try_resize(levels, gates.size())) return {"", "out of memory", ErrorCode::kOutOfMemory};
  RangeDecoder coder(reader.bytes(reader.left()));
  if (!code_levels(coder, gates, count, levels) || !coder.finished())
    return {"§6.1", "the levels of the vertices do not fill their bytes exactly"};
  std::uint64_t met = 0;
  for (const std::uint8_t level : levels) met |= std::uint64_t{1} << level;
  if (met != ~std::uint64_t{0} >> (64 - count)) return {kSection, "there is a level without a vertex"};
  return {};
}

}  // namespace tvg
