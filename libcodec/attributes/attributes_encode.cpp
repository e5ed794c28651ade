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
  writer.u8(static_cast<std::uint8_t>(static_cast<std::uint8_t>(attribute.domain) |
                                      (attribute.animated ? kAnimatedFlag : 0)));
  writer.u8(static_cast<std::uint8_t>(attribute.components));
  writer.u8(static_cast<std::uint8_t>(attribute.bits));
  writer.varint(attribute.name.size());
  writer.bytes(Bytes(reinterpret_cast<const std::uint8_t*>(attribute.name.data()), attribute.name.size()));
  if (!attribute.animated) write_steps(writer, grid);
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

/// Codes the seams between corners of which same(a, b) does not hold.
template <class Same>
Wedges code_seams(RangeEncoder& encoder, AttributeCoder& coder, std::size_t corners, const Same& same) {
  const std::span<const std::uint32_t> partner = coder.partner();
  std::vector<std::uint8_t> seams(corners);
  for (std::uint32_t h = 0; h < seams.size(); ++h) {
    const std::uint32_t back = partner[h];
    if (back != kNoCorner) seams[h] = same(h, next_corner(back)) && same(next_corner(h), back) ? 0 : 1;
  }
  coder.code_seams(encoder, seams);
  return wedges_between(partner, seams);
}

void code_corners(RangeEncoder& encoder, AttributeCoder& coder, const Written& written,
                  std::span<const std::uint32_t> corners) {
  const std::size_t width = written.grid.integers();
  const Wedges wedges = code_seams(encoder, coder, corners.size(), [&](std::uint32_t a, std::uint32_t b) {
    return std::equal(&written.integers[width * corners[a]], &written.integers[width * corners[a]] + width,
                      &written.integers[width * corners[b]]);
  });
  std::vector<std::int32_t> values = picked(written.integers, width, wedges.count(),
                                            [&](std::size_t i) { return corners[wedges.first[i]]; });
  coder.code_values(encoder, written.grid, wedges.of_corner, values);
}

/// Of an animated attribute the seams are where corners have another value by number.
AnimatedAttribute code_animated(RangeEncoder& encoder, AttributeCoder& coder, const Attribute& attribute,
                                const AttributeGrid& grid, std::span<const std::uint32_t> first_corners) {
  AnimatedAttribute animated{0, attribute.domain, grid, 0, {}, {}};
  if (attribute.domain != AttributeDomain::kCorner) return animated;
  const std::vector<std::uint32_t> corners = corners_in_order(attribute, first_corners);
  Wedges wedges = code_seams(encoder, coder, corners.size(),
                             [&](std::uint32_t a, std::uint32_t b) { return corners[a] == corners[b]; });
  animated.count = wedges.count();
  for (const std::uint32_t corner : wedges.first) animated.given.push_back(corners[corner]);
  animated.of_corner = std::move(wedges.of_corner);
  return animated;
}

}  // namespace

// format-spec §5.7
std::vector<std::uint8_t> encode_attributes(std::span<const Attribute> attributes, const PropertyMesh& mesh,
                                            std::span<const std::uint32_t> first_corners,
                                            std::size_t part_count, AnimatedAttributes& animated) {
  if (attributes.empty()) return {};
  ByteWriter writer;
  writer.varint(attributes.size());
  std::vector<AttributeGrid> grids;
  for (const Attribute& attribute : attributes) {
    const AttributeGrid like{attribute.kind, attribute.components, attribute.bits, {}, 0};
    const AttributeValues values = attribute.values;
    grids.push_back(attribute.animated ? like : grid_over(like, std::span(&values, 1)));
    write_head(writer, attribute, grids.back());
  }
  RangeEncoder encoder;
  AttributeCoder coder(mesh);
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const Attribute& attribute = attributes[i];
    if (attribute.animated) {
      AnimatedAttribute found = code_animated(encoder, coder, attribute, grids[i], first_corners);
      found.number = i;
      if (found.domain == AttributeDomain::kVertex) found.count = mesh.vertex_count();
      if (found.domain == AttributeDomain::kPart) found.count = part_count;
      animated.list.push_back(std::move(found));
      continue;
    }
    Written written{grids[i], integers_of(attribute.values, grids[i])};
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
  if (!animated.list.empty()) animated.faces.assign(mesh.faces.begin(), mesh.faces.end());
  writer.bytes(encoder.finish());
  return writer.take();
}

}  // namespace tvg
