#include "attributes/parts_encode.hpp"

#include "attributes/part_coder.hpp"
#include "base/byte_io.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

namespace tvg {

namespace {

/// Writes the names of parts, each by those before it.
class NameWriter {
 public:
  explicit NameWriter(ByteWriter& writer) : writer_(writer) {}

  // format-spec §5.8
  void write_part(const Part& before, const Part& part) {
    write_name(before.object, part.object);
    write_name(before.group, part.group);
    write_name(before.material, part.material);
  }

 private:
  void write_name(std::string_view before, std::string_view name) {
    if (name == before) {
      writer_.varint(0);
      return;
    }
    const auto [known, is_new] = met_.emplace(name, met_.size());
    if (!is_new) {
      writer_.varint(known->second + 2);
      return;
    }
    const std::size_t shared = static_cast<std::size_t>(
        std::mismatch(name.begin(), name.end(), last_.begin(), last_.end()).first - name.begin());
    writer_.varint(1);
    writer_.varint(shared);
    writer_.varint(name.size() - shared);
    const std::string_view rest = name.substr(shared);
    writer_.bytes({reinterpret_cast<const std::uint8_t*>(rest.data()), rest.size()});
    last_ = name;
  }

  ByteWriter& writer_;
  std::map<std::string_view, std::size_t> met_;
  std::string_view last_;  ///< the new name before
};

}  // namespace

// format-spec §5.8
std::vector<std::uint8_t> encode_parts(const MeshProperties& properties, const PropertyMesh& mesh,
                                       std::span<const std::uint32_t> first_corners) {
  if (properties.parts.empty()) return {};
  ByteWriter writer;
  writer.varint(properties.parts.size());
  NameWriter names(writer);
  const Part none;
  const Part* before = &none;
  for (const Part& part : properties.parts) {
    names.write_part(*before, part);
    before = &part;
  }
  if (properties.parts.size() == 1) return writer.take();
  std::vector<std::uint32_t> parts;
  parts.reserve(first_corners.size());
  for (const std::uint32_t corner : first_corners) parts.push_back(properties.face_parts[corner / 3]);
  const std::vector<std::uint32_t> partner = pair_edges(mesh.faces, mesh.vertex_count());
  PartCoder coder(partner, properties.parts.size());
  RangeEncoder encoder;
  coder.code(encoder, parts);
  writer.bytes(encoder.finish());
  return writer.take();
}

}  // namespace tvg
