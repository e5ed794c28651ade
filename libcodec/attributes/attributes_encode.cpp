#include "attributes/attributes_encode.hpp"

#include "attributes/attribute_coder.hpp"
#include "attributes/attribute_grid_encode.hpp"
#include "base/byte_io.hpp"

#include <algorithm>

namespace tvg {

namespace {

/// An attribute as it is written.
struct Written {
  AttributeGrid grid;
  std::vector<std::int32_t> integers;  ///< [value][integer]
};

void write_head(ByteWriter& writer, const Attribute& attribute, const AttributeGrid& grid) {
  writer.u8(static_cast<std::uint8_t>(attribute.kind));
  writer.u8(static_cast<std::uint8_t>(attribute.domain));
  writer.u8(static_cast<std::uint8_t>(attribute.components));
  writer.u8(static_cast<std::uint8_t>(attribute.bits));
  writer.varint(attribute.name.size());
  writer.bytes(Bytes(reinterpret_cast<const std::uint8_t*>(attribute.name.data()), attribute.name.size()));
  if (!grid.stepped()) return;
  for (std::size_t c = 0; c < grid.components; ++c) writer.u32(bits_as<std::uint32_t>(grid.origin[c]));
  writer.f64(grid.range);
}

/// The corners of an attribute in the order of the traversal: [3 * face + corner] = value.
std::vector<std::uint32_t> corners_in_order(const Attribute& attribute,
                                            std::span<const std::uint32_t> first_corners) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * first_corners.size());
  for (std::uint32_t corner : first_corners) {
    for (int i = 0; i < 3; ++i, corner = next_corner(corner)) corners.push_back(attribute.corners[corner]);
  }
  return corners;
}

/// Picks values by number.
std::vector<std::int32_t> picked(std::span<const std::int32_t> integers, std::size_t width, std::size_t count,
                                 const auto& number) {
  std::vector<std::int32_t> result;
  result.reserve(width * count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = integers.subspan(width * number(i), width);
    result.insert(result.end(), value.begin(), value.end());
  }
  return result;
}

void code_corners(RangeEncoder& encoder, AttributeCoder& coder, const Written& written,
                  std::span<const std::uint32_t> corners) {
  const std::size_t width = written.grid.integers();
  const auto same = [&](std::uint32_t a, std::uint32_t b) {
    return std::equal(&written.integers[width * corners[a]], &written.integers[width * corners[a]] + width,
                      &written.integers[width * corners[b]]);
  };
  const std::span<const std::uint32_t> partner = coder.partner();
  std::vector<std::uint8_t> seams(corners.size());
  for (std::uint32_t h = 0; h < seams.size(); ++h) {
    const std::uint32_t back = partner[h];
    if (back != kNoCorner) seams[h] = same(h, next_corner(back)) && same(next_corner(h), back) ? 0 : 1;
  }
  coder.code_seams(encoder, seams);
  const Wedges wedges = wedges_between(partner, seams);
  std::vector<std::int32_t> values = picked(written.integers, width, wedges.count(),
                                            [&](std::size_t i) { return corners[wedges.first[i]]; });
  coder.code_values(encoder, written.grid, wedges.of_corner, values);
}

}  // namespace

// format-spec §5.7
std::vector<std::uint8_t> encode_attributes(std::span<const Attribute> attributes, const PropertyMesh& mesh,
                                            std::span<const std::uint32_t> first_corners) {
  if (attributes.empty()) return {};
  ByteWriter writer;
  writer.varint(attributes.size());
  std::vector<AttributeGrid> grids;
  for (const Attribute& attribute : attributes) {
    grids.push_back(grid_over(attribute));
    write_head(writer, attribute, grids.back());
  }
  RangeEncoder encoder;
  AttributeCoder coder(mesh);
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const Attribute& attribute = attributes[i];
    Written written{grids[i], integers_of(attribute, grids[i])};
    if (attribute.domain == AttributeDomain::kCorner) {
      code_corners(encoder, coder, written, corners_in_order(attribute, first_corners));
      continue;
    }
    if (attribute.domain == AttributeDomain::kVertex) {
      written.integers = picked(written.integers, written.grid.integers(), mesh.vertex_count(),
                                [&](std::size_t t) { return mesh.order[t]; });
    }
    const std::vector<std::uint32_t> of_corner = attribute.domain == AttributeDomain::kVertex
                                                     ? corners_of_vertices(mesh.faces)
                                                     : std::vector<std::uint32_t>();
    coder.code_values(encoder, written.grid, of_corner, written.integers);
  }
  writer.bytes(encoder.finish());
  return writer.take();
}

}  // namespace tvg
