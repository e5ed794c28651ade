#include "attributes/attributes.hpp"

#include "attributes/attributes_encode.hpp"
#include "connectivity/connectivity_encode.hpp"
#include "tests/codec/properties_toolbox.hpp"

#include <limits>

// The section of attributes by itself.
namespace tvg::test {
namespace {

/// A mesh with attributes of all sorts and its section.
struct Coded {
  explicit Coded(const Mesh& given, bool with_shape, std::uint32_t seed) : mesh(given), random(seed) {
    connectivity = encode_connectivity(mesh);
    shape.bits = 10;
    std::uniform_int_distribution<std::int32_t> index(0, 1023);
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v)
      shape.indices.push_back({index(random), index(random), index(random)});
    seen = {connectivity.connectivity.faces, connectivity.order, with_shape ? &shape : nullptr};
    const auto corners = [&](AttributeKind kind, std::uint32_t components, int bits, double seams) {
      return random_corners(attribute_of("a", kind, AttributeDomain::kCorner, components, bits), mesh, seams,
                            random);
    };
    const auto values = [&](AttributeKind kind, AttributeDomain domain, std::uint32_t components, int bits) {
      return random_values(attribute_of("", kind, domain, components, bits),
                           domain == AttributeDomain::kPart ? kParts : mesh.vertex_count, random);
    };
    attributes = {corners(AttributeKind::kTexcoord, 2, 12, 0.2),
                  corners(AttributeKind::kNormal, 3, 10, 0.2),
                  corners(AttributeKind::kColour, 4, 8, 0),
                  values(AttributeKind::kNormal, AttributeDomain::kVertex, 3, 9),
                  values(AttributeKind::kGeneric, AttributeDomain::kVertex, 1, 24),
                  values(AttributeKind::kGeneric, AttributeDomain::kVertex, 3, Attribute::kExact),
                  values(AttributeKind::kGeneric, AttributeDomain::kPart, 2, 5)};
    AnimatedAttributes animated;
    section = encode_attributes(attributes, seen, connectivity.first_corners, kParts, animated);
  }

  Result<std::vector<Attribute>> decode(std::span<const std::uint8_t> bytes) const {
    PropertyBudget budget(std::numeric_limits<std::uint32_t>::max());
    AnimatedAttributes animated;
    return decode_attributes(bytes, seen, kParts, budget, animated);
  }

  static constexpr std::size_t kParts = 5;
  Mesh mesh;
  std::mt19937 random;
  EncodedConnectivity connectivity;
  ReferenceShape shape;
  PropertyMesh seen;
  std::vector<Attribute> attributes;
  std::vector<std::uint8_t> section;
};

TEST(Attributes, ComeBackTheSameWhenTheyAreCodedAgain) {
  std::uint32_t seed = 0;
  for (const auto& [name, mesh] : all_sorts_of_meshes()) {
    for (const bool with_shape : {false, true}) {
      SCOPED_TRACE(name);
      const Coded coded(mesh, with_shape, ++seed);
      const Result<std::vector<Attribute>> decoded = coded.decode(coded.section);
      ASSERT_TRUE(decoded) << decoded.error().describe();
      ASSERT_EQ(decoded->size(), coded.attributes.size());
      // Corners of what is decoded are those of the traversal: the first of each face stands first.
      std::vector<std::uint32_t> first(mesh.faces.size());
      for (std::uint32_t f = 0; f < first.size(); ++f) first[f] = 3 * f;
      std::vector<Attribute> exact = *decoded;
      AnimatedAttributes animated;
      const std::vector<std::uint8_t> again =
          encode_attributes(exact, coded.seen, first, Coded::kParts, animated);
      const Result<std::vector<Attribute>> twice = coded.decode(again);
      ASSERT_TRUE(twice) << twice.error().describe();
      for (std::size_t i = 0; i < exact.size(); ++i) {
        EXPECT_EQ((*twice)[i].corners, exact[i].corners);
        if (exact[i].bits != Attribute::kExact) continue;
        EXPECT_EQ((*twice)[i].values, exact[i].values);
      }
    }
  }
}

TEST(Attributes, WithTheSameSeamsPayForThemOnce) {
  std::mt19937 random(3);
  const Mesh mesh = grid(40, 40);
  const EncodedConnectivity connectivity = encode_connectivity(mesh);
  const PropertyMesh seen{connectivity.connectivity.faces, connectivity.order, nullptr};
  const Attribute one = random_corners(
      attribute_of("", AttributeKind::kTexcoord, AttributeDomain::kCorner, 2, 1), mesh, 0.2, random);
  Attribute flat = one;  // of one value, but for the seams
  const auto size = [&](std::vector<Attribute> attributes) {
    AnimatedAttributes animated;
    return encode_attributes(attributes, seen, connectivity.first_corners, 0, animated).size();
  };
  EXPECT_LT(size({one, flat}) - size({one}), size({one}) - 100);
}

TEST(Attributes, CutShortAreRefused) {
  for (const bool with_shape : {false, true}) {
    const Coded coded(grid(5, 4), with_shape, 7);
    for (std::size_t size = 0; size < coded.section.size(); ++size) {
      const std::vector<std::uint8_t> cut(coded.section.begin(),
                                          coded.section.begin() + static_cast<std::ptrdiff_t>(size));
      const Result<std::vector<Attribute>> decoded = coded.decode(cut);
      ASSERT_FALSE(decoded) << size;
      EXPECT_EQ(decoded.error().code, ErrorCode::kMalformed);
    }
  }
}

TEST(Attributes, DamagedAreRefusedOrValid) {
  std::mt19937 random(4);
  for (const bool with_shape : {false, true}) {
    const Coded coded(joined(grid(5, 4, true), random_soup(9, 20, random)), with_shape, 8);
    for (std::size_t i = 0; i < 8 * coded.section.size(); i += 7) {
      std::vector<std::uint8_t> damaged = coded.section;
      damaged[i / 8] = static_cast<std::uint8_t>(damaged[i / 8] ^ 1u << i % 8);
      const Result<std::vector<Attribute>> decoded = coded.decode(damaged);
      if (!decoded) continue;
      for (const Attribute& attribute : *decoded) {
        for (const std::uint32_t value : attribute.corners) ASSERT_LT(value, attribute.value_count());
        for (const float x : attribute.values) ASSERT_TRUE(std::isfinite(x));
      }
    }
  }
}

TEST(Attributes, AreNotDecodedBeyondTheBudget) {
  const Coded coded(grid(5, 4), true, 9);
  std::uint64_t bytes = 0;
  for (const Attribute& attribute : coded.attributes)
    bytes += attribute_bytes({coded.mesh.vertex_count, coded.mesh.faces.size(), Coded::kParts},
                             attribute.domain, attribute.components, attribute.name.size());
  PropertyBudget enough(bytes), short_of_one(bytes - 1);
  AnimatedAttributes animated;
  EXPECT_TRUE(decode_attributes(coded.section, coded.seen, Coded::kParts, enough, animated));
  const Result<std::vector<Attribute>> refused =
      decode_attributes(coded.section, coded.seen, Coded::kParts, short_of_one, animated);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimitExceeded);
}

}  // namespace
}  // namespace tvg::test
