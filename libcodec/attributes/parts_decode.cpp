#include "attributes/part_coder.hpp"
#include "attributes/parts.hpp"
#include "base/allocation.hpp"
#include "base/stream_error.hpp"

#include <array>
#include <string>
#include <utility>

namespace tvg {

namespace {

constexpr const char* kSection = "§5.8";
constexpr Fault kTooLarge{kSection, "the properties of a mesh take more than the head declares",
                          ErrorCode::kLimitExceeded};
constexpr Fault kNoMemory{"", "", ErrorCode::kOutOfMemory};

/// Reads the names of parts, each by those before it.
class NameReader {
 public:
  NameReader(ByteReader& reader, PropertyBudget& budget, std::vector<Part>& parts)
      : reader_(reader), budget_(budget), parts_(parts) {}

  // format-spec §5.8
  Fault read_part() {
    if (!budget_.take(part_bytes(0))) return kTooLarge;
    if (!try_push_back(parts_, Part())) return kNoMemory;
    const auto number = static_cast<std::uint32_t>(parts_.size() - 1);
    for (std::size_t field = 0; field < kFields.size(); ++field) {
      if (const Fault fault = read_name({number, field})) return fault;
    }
    return {};
  }

 private:
  static constexpr std::array<std::string Part::*, 3> kFields = {&Part::object, &Part::group,
                                                                 &Part::material};
  /// Where a text stands that was met before.
  struct Place {
    std::uint32_t part = 0;
    std::size_t field = 0;
  };

  Fault read_name(Place place) {
    const std::uint64_t number = reader_.varint();
    if (number == 1) return read_new_name(place);
    if (number == 0) return place.part == 0 ? Fault() : copy({place.part - 1, place.field}, place);
    if (!reader_.ok() || number - 2 >= met_.size()) return {kSection, "a part has a name that is not there"};
    return copy(met_[static_cast<std::size_t>(number - 2)], place);
  }

  Fault read_new_name(Place place) {
    const std::string_view before = met_.empty() ? std::string_view() : text(met_.back());
    const std::uint64_t shared = reader_.varint();
    const Bytes rest = reader_.bytes(reader_.varint());
    if (!reader_.ok() || shared > before.size()) return {kSection, "a name of a part is cut short"};
    const auto kept = static_cast<std::size_t>(shared);
    if (!budget_.take(kept + rest.size())) return kTooLarge;
    if (!can_allocate(kept + rest.size() + kSmallThings)) return kNoMemory;
    std::string& name = text(place);
    name.assign(before.substr(0, kept));
    name.append(reinterpret_cast<const char*>(rest.data()), rest.size());
    if (!is_metadata_text(name)) return {kSection, "a name of a part is no text in UTF-8"};
    return try_push_back(met_, place) ? Fault() : kNoMemory;
  }

  Fault copy(Place from, Place to) {
    if (!budget_.take(text(from).size())) return kTooLarge;
    if (!can_allocate(text(from).size() + kSmallThings)) return kNoMemory;
    text(to) = text(from);
    return {};
  }

  std::string& text(Place place) { return parts_[place.part].*kFields[place.field]; }

  ByteReader& reader_;
  PropertyBudget& budget_;
  std::vector<Part>& parts_;
  std::vector<Place> met_;  ///< new names, in their order
};

// format-spec §5.8
Fault parse(ByteReader reader, const PropertyMesh& mesh, PropertyBudget& budget, MeshProperties& properties) {
  const std::uint64_t count = reader.varint();
  if (!reader.ok() || count == 0 || count > reader.left() / 3)
    return {kSection, "the number of parts is out of range"};
  NameReader names(reader, budget, properties.parts);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (const Fault fault = names.read_part()) return fault;
  }
  if (!budget.take(kFacePartBytes * mesh.faces.size())) return kTooLarge;
  if (!try_resize(properties.face_parts, mesh.faces.size())) return kNoMemory;
  if (count == 1)
    return reader.finished() ? Fault() : Fault{kSection, "bytes follow a part that is the only one"};
  const std::size_t working = pair_edges_bytes(mesh.faces.size(), mesh.vertex_count());
  if (!can_allocate(working + static_cast<std::size_t>(count) + kSmallThings)) return kNoMemory;
  const std::vector<std::uint32_t> partner = pair_edges(mesh.faces, mesh.vertex_count());
  RangeDecoder decoder(reader.bytes(reader.left()));
  PartCoder coder(partner, static_cast<std::size_t>(count));
  if (!coder.code(decoder, properties.face_parts) || !decoder.finished())
    return {kSection, "the parts of faces are damaged"};
  return {};
}

}  // namespace

Status decode_parts(Bytes section, const PropertyMesh& mesh, PropertyBudget& budget,
                    MeshProperties& properties) {
  const Fault fault = parse(ByteReader(section), mesh, budget, properties);
  if (!fault) return {};
  return fault.code == ErrorCode::kOutOfMemory ? out_of_memory() : error_of(fault);
}

}  // namespace tvg
