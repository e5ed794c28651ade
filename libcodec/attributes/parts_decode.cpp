#include "attributes/parts.hpp"
#include "base/allocation.hpp"
#include "base/stream_error.hpp"

#include <string>

namespace tvg {

namespace {

constexpr const char* kSection = "§5.8";

// format-spec §5.8
Fault parse(ByteReader reader, const PropertyMesh& mesh, PropertyBudget& budget, MeshProperties& properties) {
  constexpr Fault kTooLarge{kSection, "the properties of a mesh take more than the head declares",
                            ErrorCode::kLimitExceeded};
  constexpr Fault kNoMemory{"", "", ErrorCode::kOutOfMemory};
  const std::uint64_t count = reader.varint();
  if (!reader.ok() || count == 0 || count > reader.left() / 3)
    return {kSection, "the number of parts is out of range"};
  if (!budget.take(kFacePartBytes * mesh.faces.size())) return kTooLarge;
  for (std::uint64_t i = 0; i < count; ++i) {
    Part part;
    for (std::string* text : {&part.object, &part.group, &part.material}) {
      const Bytes bytes = reader.bytes(reader.varint());
      if (!can_allocate(bytes.size() + kSmallThings)) return kNoMemory;
      text->assign(bytes.begin(), bytes.end());
      if (!reader.ok() || !is_metadata_text(*text)) return {kSection, "a name of a part is no text in UTF-8"};
    }
    if (!budget.take(part_bytes(part.object.size() + part.group.size() + part.material.size())))
      return kTooLarge;
    if (!try_push_back(properties.parts, std::move(part))) return kNoMemory;
  }
  if (!try_resize(properties.face_parts, mesh.faces.size())) return kNoMemory;
  for (std::uint32_t& part : properties.face_parts) {
    const std::uint64_t number = reader.varint();
    if (!reader.ok() || number >= count) return {kSection, "a face is of a part that is not there"};
    part = static_cast<std::uint32_t>(number);
  }
  return reader.finished() ? Fault() : Fault{kSection, "the parts do not fill their section exactly"};
}

}  // namespace

// format-spec §5.8
Status decode_parts(Bytes section, const PropertyMesh& mesh, PropertyBudget& budget,
                    MeshProperties& properties) {
  const Fault fault = parse(ByteReader(section), mesh, budget, properties);
  if (!fault) return {};
  return fault.code == ErrorCode::kOutOfMemory ? out_of_memory() : error_of(fault);
}

}  // namespace tvg
