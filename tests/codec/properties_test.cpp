#include "tests/codec/properties_toolbox.hpp"

#include <cmath>
#include <limits>

namespace tvg::test {
namespace {

using Domain = AttributeDomain;
using Kind = AttributeKind;

MeshProperties properties_of_all_sorts(const Mesh& mesh, std::mt19937& random) {
  MeshProperties properties;
  properties.parts = {{"body", "", "skin"}, {"body", "eyes", "glass"}, {"", "", ""}};
  std::uniform_int_distribution<std::uint32_t> part(0, 2);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) properties.face_parts.push_back(part(random));
  const auto corners = [&](Kind kind, std::uint32_t components, double seams) {
    return random_corners(attribute_of("", kind, Domain::kCorner, components), mesh, seams, random);
  };
  properties.attributes = {
      corners(Kind::kTexcoord, 2, 0.1),
      random_values(attribute_of("mass", Kind::kGeneric, Domain::kVertex, 1), mesh.vertex_count, random),
      corners(Kind::kNormal, 3, 1),
      corners(Kind::kColour, 4, 0),
      random_values(attribute_of("weight", Kind::kGeneric, Domain::kPart, 4), 3, random),
  };
  return properties;
}

Stream encode_with(const Sequence& sequence, const MeshProperties& properties,
                   const EncodeOptions& options = {}) {
  PropertySource source(sequence, properties);
  Result<Stream> stream = try_encode(source, options);
  EXPECT_TRUE(stream) << (stream ? "" : stream.error().describe());
  return stream ? *stream : Stream();
}

TEST(Properties, ExactOnesComeBackBitForBitWhateverTheMesh) {
  std::mt19937 random(1);
  for (const auto& [name, mesh] : all_sorts_of_meshes()) {
    SCOPED_TRACE(name);
    if (mesh.vertex_count == 0) continue;
    const Sequence sequence = random_sequence(mesh, 2, random);
    const MeshProperties properties = properties_of_all_sorts(mesh, random);
    for (const Mode mode : {Mode::kElp, Mode::kLossless}) {
      EncodeOptions options;
      options.mode = mode;
      const DecodedProperties decoded = decode_properties_of(encode_with(sequence, properties, options));
      ASSERT_TRUE(decoded.complete) << decoded.error.describe();
      EXPECT_EQ(decoded.properties.parts, properties.parts);
      ASSERT_EQ(decoded.properties.attributes.size(), properties.attributes.size());
      EXPECT_EQ(decoded.properties.attributes[1], properties.attributes[1]);
      EXPECT_EQ(decoded.properties.attributes[4], properties.attributes[4]);
      EXPECT_EQ(face_records(decoded.mesh, decoded.properties), face_records(mesh, properties));
    }
  }
}

TEST(Properties, QuantizedValuesAreOffByHalfAStepAtMost) {
  std::mt19937 random(2);
  const Mesh mesh = grid(9, 7);
  MeshProperties properties;
  properties.attributes = {
      random_values(attribute_of("", Kind::kTexcoord, Domain::kVertex, 2, 12), mesh.vertex_count, random),
      random_values(attribute_of("", Kind::kGeneric, Domain::kVertex, 3, 1), mesh.vertex_count, random),
      random_values(attribute_of("", Kind::kGeneric, Domain::kVertex, 4, 24), mesh.vertex_count, random)};
  const DecodedProperties decoded =
      decode_properties_of(encode_with(random_sequence(mesh, 1, random), properties));
  ASSERT_TRUE(decoded.complete) << decoded.error.describe();
  for (std::size_t i = 0; i < properties.attributes.size(); ++i) {
    const Attribute& given = properties.attributes[i];
    const auto [low, high] = std::minmax_element(given.values.begin(), given.values.end());
    const double half = (static_cast<double>(*high) - *low) / ((1 << given.bits) - 1) / 2;
    for (std::size_t k = 0; k < given.values.size(); ++k)
      EXPECT_NEAR(decoded.properties.attributes[i].values[k], given.values[k], half + 1e-4);
  }
}

TEST(Properties, QuantizedNormalsAreUnitVectorsNearby) {
  std::mt19937 random(3);
  const Mesh mesh = grid(20, 20);
  Attribute normals =
      random_values(attribute_of("", Kind::kNormal, Domain::kVertex, 3), mesh.vertex_count, random);
  const float axes[] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0};
  std::copy(std::begin(axes), std::end(axes), normals.values.begin());
  for (const int bits : {2, 8, 10, 16}) {
    normals.bits = bits;
    MeshProperties properties;
    properties.attributes = {normals};
    const DecodedProperties decoded =
        decode_properties_of(encode_with(random_sequence(mesh, 1, random), properties));
    ASSERT_TRUE(decoded.complete) << decoded.error.describe();
    const std::vector<float>& values = decoded.properties.attributes[0].values;
    EXPECT_TRUE(std::equal(std::begin(axes), std::end(axes), values.begin()));
    for (std::size_t i = 7; i < mesh.vertex_count; ++i) {
      const std::span given = std::span(normals.values).subspan(3 * i, 3);
      const double length = std::hypot(given[0], given[1], given[2]);
      double off = 0, square = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        off += std::pow(values[3 * i + c] - given[c] / length, 2);
        square += static_cast<double>(values[3 * i + c]) * values[3 * i + c];
      }
      EXPECT_NEAR(square, 1, 1e-6);
      EXPECT_LT(std::sqrt(off), 6.0 / (1 << bits));
    }
  }
}

TEST(Properties, BitsOfTheKindAreThoseOfTheOptions) {
  std::mt19937 random(4);
  const Mesh mesh = grid(3, 3);
  MeshProperties properties;
  constexpr int kOfKind = Attribute::kBitsOfKind;
  for (const Kind kind : {Kind::kTexcoord, Kind::kNormal, Kind::kColour, Kind::kGeneric})
    properties.attributes.push_back(
        random_values(attribute_of("", kind, Domain::kVertex, 3, kOfKind), mesh.vertex_count, random));
  EncodeOptions options;
  options.attribute_bits = {.texcoord = 14, .normal = 9, .colour = 5, .generic = 20};
  const DecodedProperties decoded =
      decode_properties_of(encode_with(random_sequence(mesh, 1, random), properties, options));
  ASSERT_TRUE(decoded.complete);
  const std::vector<Attribute>& attributes = decoded.properties.attributes;
  ASSERT_EQ(attributes.size(), 4u);
  EXPECT_EQ(attributes[0].bits, 14);
  EXPECT_EQ(attributes[1].bits, 9);
  EXPECT_EQ(attributes[2].bits, 5);
  EXPECT_EQ(attributes[3].bits, 20);
}

TEST(Properties, WhatDoesNotFitTheMeshIsRefused) {
  std::mt19937 random(5);
  const Sequence sequence = random_sequence(grid(3, 3), 1, random);
  const Mesh& mesh = sequence.mesh;
  const auto code_of = [&](const MeshProperties& properties) {
    PropertySource source(sequence, properties);
    const Result<Stream> stream = try_encode(source, {});
    return stream ? ErrorCode::kIo : stream.error().code;
  };
  const auto with = [&](Attribute attribute) {
    MeshProperties properties;
    properties.attributes = {std::move(attribute)};
    return properties;
  };
  const Attribute vertices =
      random_values(attribute_of("", Kind::kGeneric, Domain::kVertex, 2), mesh.vertex_count, random);
  EXPECT_EQ(code_of(with(vertices)), ErrorCode::kIo);
  Attribute bad = vertices;
  bad.values[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(code_of(with(bad)), ErrorCode::kInvalidInput);
  bad = vertices;
  bad.values.resize(bad.values.size() - 2);
  EXPECT_EQ(code_of(with(bad)), ErrorCode::kInvalidInput);
  bad = vertices;
  bad.bits = 25;
  EXPECT_EQ(code_of(with(bad)), ErrorCode::kInvalidArgument);
  bad = vertices;
  bad.kind = Kind::kNormal;
  EXPECT_EQ(code_of(with(bad)), ErrorCode::kInvalidInput);
  bad = vertices;
  bad.name = "\xFF";
  EXPECT_EQ(code_of(with(bad)), ErrorCode::kInvalidInput);
  bad = random_corners(attribute_of("", Kind::kTexcoord, Domain::kCorner, 2), mesh, 0.5, random);
  EXPECT_EQ(code_of(with(bad)), ErrorCode::kIo);
  bad.corners.back() = static_cast<std::uint32_t>(bad.value_count());
  EXPECT_EQ(code_of(with(bad)), ErrorCode::kInvalidInput);
  bad.corners.pop_back();
  EXPECT_EQ(code_of(with(bad)), ErrorCode::kInvalidInput);
  MeshProperties parts;
  parts.parts = {{}};
  EXPECT_EQ(code_of(parts), ErrorCode::kInvalidInput);
  parts.face_parts.assign(mesh.faces.size(), 1);
  EXPECT_EQ(code_of(parts), ErrorCode::kInvalidInput);
}

TEST(Properties, TheHeadBoundsWhatTheyTake) {
  std::mt19937 random(6);
  const Sequence sequence = random_sequence(grid(5, 5), 1, random);
  const MeshProperties properties = properties_of_all_sorts(sequence.mesh, random);
  const Stream stream = encode_with(sequence, properties);
  DecoderLimits limits;
  limits.property_bytes = static_cast<std::uint32_t>(property_bytes_of(properties, sequence.mesh));
  EXPECT_TRUE(decode_properties_of(stream, limits).complete);
  --limits.property_bytes;
  EXPECT_EQ(decode_properties_of(stream, limits).error.code, ErrorCode::kLimitExceeded);
}

TEST(Properties, AttributesOfASingleFrameArePredictedFromItsShape) {
  std::mt19937 random(7);
  const Mesh mesh = grid(9, 9);
  MeshProperties properties;
  properties.attributes = {
      random_corners(attribute_of("", Kind::kTexcoord, Domain::kCorner, 2, 12), mesh, 0, random)};
  const auto shape_bytes = [&](std::size_t frames, const MeshProperties& beside) {
    Decoder decoder;
    decoder.push(encode_with(random_sequence(mesh, frames, random), beside));
    while (decoder.poll() != Decoder::Event::kFrame) {
    }
    return decoder.mesh_info().shape_bytes;
  };
  EXPECT_GT(shape_bytes(1, properties), 0u);
  EXPECT_EQ(shape_bytes(2, properties), 0u);
  EXPECT_EQ(shape_bytes(1, {}), 0u);
}

TEST(Properties, TheSameInputGivesTheSameBytes) {
  std::mt19937 random(8);
  const Sequence sequence = random_sequence(closed_surface(12, 7), 1, random);
  const MeshProperties properties = properties_of_all_sorts(sequence.mesh, random);
  EXPECT_EQ(encode_with(sequence, properties), encode_with(sequence, properties));
}

}  // namespace
}  // namespace tvg::test
