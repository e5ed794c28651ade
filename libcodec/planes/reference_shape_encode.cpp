#include "planes/reference_shape_encode.hpp"

#include "entropy/range_coder.hpp"
#include "planes/shape_coder.hpp"

namespace tvg {

// format-spec §5.3
std::vector<std::uint8_t> encode_reference_shape(const ReferenceShape& shape, std::span<const Face> faces) {
  ByteWriter writer;
  writer.u8(static_cast<std::uint8_t>(shape.bits));
  writer.u8(static_cast<std::uint8_t>(shape.neighbours));
  for (const double x : shape.origin) writer.f64(x);
  writer.f64(shape.step);
  RangeEncoder coder;
  std::vector<std::array<std::int32_t, 3>> indices = shape.indices;
  ShapeCoder(faces, static_cast<std::uint32_t>(indices.size()), shape.bits).code(coder, std::span(indices));
  writer.bytes(coder.finish());
  return writer.take();
}

}  // namespace tvg
