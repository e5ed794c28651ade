#include "attributes/attribute_coder.hpp"
#include "attributes/attributes.hpp"
#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "container/numbers.hpp"

#include <cmath>
#include <utility>

namespace tvg {

namespace {

constexpr const char* kSection = "§5.7";
constexpr Fault kTooLarge{kSection, "the properties of a mesh take more than the head declares",
                          ErrorCode::kLimitExceeded};
constexpr Fault kNoMemory{"", "", ErrorCode::kOutOfMemory};

bool has_valid_shape(const Attribute& attribute) {
  if (attribute.components < 1 || attribute.components > kMaxAttributeComponents) return false;
  const std::uint32_t components = attribute.components;
  switch (attribute.kind) {
    case AttributeKind::kNormal:
      return components == 3 && attribute.bits <= kMaxNormalBits &&
             (attribute.bits == Attribute::kExact || attribute.bits >= kMinNormalBits);
    case AttributeKind::kColour:
      return components >= 3 && attribute.bits <= kMaxAttributeBits;
    case AttributeKind::kTexcoord:
    case AttributeKind::kGeneric:
      return attribute.bits <= kMaxAttributeBits;
  }
  return false;
}

// format-spec §5.7
Fault read_head(ByteReader& reader, Attribute& attribute, AttributeGrid& grid) {
  attribute.kind = static_cast<AttributeKind>(reader.u8());
  const std::uint8_t domain = reader.u8();
  attribute.domain = static_cast<AttributeDomain>(domain & ~kAnimatedFlag);
  attribute.animated = (domain & kAnimatedFlag) != 0;
  attribute.components = reader.u8();
  attribute.bits = reader.u8();
  const Bytes name = reader.bytes(reader.varint());
  if (!reader.ok()) return {kSection, "the attributes end before their values"};
  if (attribute.domain > AttributeDomain::kPart || !has_valid_shape(attribute))
    return {kSection, "an attribute is of a kind that is not allowed"};
  if (!can_allocate(name.size() + kSmallThings)) return kNoMemory;
  attribute.name.assign(name.begin(), name.end());
  if (!is_metadata_text(attribute.name)) return {kSection, "the name of an attribute is no text in UTF-8"};
  grid = {attribute.kind, attribute.components, attribute.bits, {}, 0};
  return attribute.animated ? Fault() : read_steps(reader, grid);
}

/// Reads the stream behind the heads.
class Reading {
 public:
  Reading(Bytes stream, const PropertyMesh& mesh, std::size_t part_count)
      : mesh_(mesh), part_count_(part_count), decoder_(stream), coder_(mesh) {}

  Fault take(const AttributeGrid& grid, Attribute& attribute) {
    std::vector<std::uint32_t> of_corner;
    std::size_t count = 0;
    if (!take_corners(attribute, of_corner, count)) return damaged();
    const std::size_t width = grid.integers(), components = grid.components;
    if (!can_allocate(4 * (width + components) * count)) return kNoMemory;
    std::vector<std::int32_t> integers(width * count);
    if (!coder_.code_values(decoder_, grid, of_corner, integers)) return damaged();
    if (attribute.domain == AttributeDomain::kCorner) attribute.corners = std::move(of_corner);
    attribute.values.resize(components * count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t place = attribute.domain == AttributeDomain::kVertex ? mesh_.order[i] : i;
      grid.value_of(std::span(integers).subspan(width * i, width),
                    std::span(attribute.values).subspan(components * place, components));
    }
    return {};
  }

  /// One that is animated, whose values come with frames.
  Fault take_animated(const AttributeGrid& grid, std::size_t number, Attribute& attribute,
                      AnimatedAttributes& animated) {
    AnimatedAttribute found{number, attribute.domain, grid, 0, {}, {}};
    if (!take_corners(attribute, found.of_corner, found.count)) return damaged();
    if (!can_allocate(4 * (grid.components * found.count + 2 * found.of_corner.size()) + kSmallThings))
      return kNoMemory;
    attribute.values.resize(grid.components * found.count);
    if (attribute.domain == AttributeDomain::kVertex) found.of_corner = {};
    attribute.corners = found.of_corner;
    animated.list.push_back(std::move(found));
    return {};
  }

  Fault finish() const { return decoder_.finished() ? Fault() : damaged(); }

 private:
  /// Which value each corner has, as far as they have any, and how many there are; false where the stream is
  /// malformed.
  bool take_corners(const Attribute& attribute, std::vector<std::uint32_t>& of_corner, std::size_t& count) {
    count = part_count_;
    if (attribute.domain == AttributeDomain::kPart) return true;
    if (attribute.domain == AttributeDomain::kVertex) {
      of_corner = corners_of_vertices(mesh_.faces);
      count = mesh_.vertex_count();
      return true;
    }
    std::vector<std::uint8_t> seams(3 * mesh_.faces.size());
    if (!coder_.code_seams(decoder_, seams)) return false;
    Wedges wedges = wedges_between(coder_.partner(), seams);
    count = wedges.count();
    of_corner = std::move(wedges.of_corner);
    return true;
  }

  static Fault damaged() { return {kSection, "the values of the attributes are damaged"}; }

  const PropertyMesh& mesh_;
  std::size_t part_count_;
  RangeDecoder decoder_;
  AttributeCoder coder_;
};

Fault read_all(ByteReader reader, const PropertyMesh& mesh, std::size_t part_count, PropertyBudget& budget,
               std::vector<Attribute>& attributes, AnimatedAttributes& animated) {
  const std::uint64_t count = reader.varint();
  if (!reader.ok() || count == 0 || count > kMaxAttributes)
    return {kSection, "the number of attributes is out of range"};
  std::array<AttributeGrid, kMaxAttributes> grids;
  if (!try_resize(attributes, static_cast<std::size_t>(count))) return kNoMemory;
  for (std::size_t i = 0; i < count; ++i) {
    if (const Fault fault = read_head(reader, attributes[i], grids[i])) return fault;
    const Attribute& head = attributes[i];
    const auto bytes_of = head.animated ? animated_bytes : attribute_bytes;
    if (!budget.take(bytes_of({mesh.vertex_count(), mesh.faces.size(), part_count}, head.domain,
                              head.components, head.name.size())))
      return kTooLarge;
  }
  const std::uint64_t working = AttributeCoder::bytes(mesh, part_count) + kSmallThings;
  if (working > static_cast<std::size_t>(-1) / 2 || !can_allocate(static_cast<std::size_t>(working)))
    return kNoMemory;
  Reading reading(reader.bytes(reader.left()), mesh, part_count);
  for (std::size_t i = 0; i < count; ++i) {
    const Fault fault = attributes[i].animated ? reading.take_animated(grids[i], i, attributes[i], animated)
                                               : reading.take(grids[i], attributes[i]);
    if (fault) return fault;
  }
  if (!animated.list.empty()) {
    if (!try_resize(animated.faces, mesh.faces.size())) return kNoMemory;
    std::copy(mesh.faces.begin(), mesh.faces.end(), animated.faces.begin());
  }
  return reading.finish();
}

}  // namespace

// format-spec §5.7
Fault read_steps(ByteReader& reader, AttributeGrid& grid) {
  if (!grid.stepped()) return {};
  bool finite = true;
  for (std::size_t c = 0; c < grid.components; ++c) {
    grid.origin[c] = bits_as<float>(reader.u32());
    finite = finite && std::isfinite(grid.origin[c]);
  }
  grid.range = reader.f64();
  if (!reader.ok()) return {kSection, "the attributes end before their values"};
  if (!finite || !std::isfinite(grid.range) || !(grid.range >= 0))
    return {kSection, "the grid of an attribute is not finite"};
  return {};
}

// format-spec §5.7
Result<std::vector<Attribute>> decode_attributes(Bytes section, const PropertyMesh& mesh,
                                                 std::size_t part_count, PropertyBudget& budget,
                                                 AnimatedAttributes& animated) {
  std::vector<Attribute> attributes;
  const Fault fault = read_all(ByteReader(section), mesh, part_count, budget, attributes, animated);
  if (!fault) return attributes;
  return fault.code == ErrorCode::kOutOfMemory ? out_of_memory() : error_of(fault);
}

}  // namespace tvg
