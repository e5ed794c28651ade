#include "attributes/parts_encode.hpp"

#include "base/byte_io.hpp"

#include <string>

namespace tvg {

// format-spec §5.8
std::vector<std::uint8_t> encode_parts(const MeshProperties& properties, const PropertyMesh& /*mesh*/,
                                       std::span<const std::uint32_t> first_corners) {
  if (properties.parts.empty()) return {};
  ByteWriter writer;
  writer.varint(properties.parts.size());
  for (const Part& part : properties.parts) {
    for (const std::string* text : {&part.object, &part.group, &part.material}) {
      writer.varint(text->size());
      writer.bytes(Bytes(reinterpret_cast<const std::uint8_t*>(text->data()), text->size()));
    }
  }
  for (const std::uint32_t corner : first_corners) writer.varint(properties.face_parts[corner / 3]);
  return writer.take();
}

}  // namespace tvg
