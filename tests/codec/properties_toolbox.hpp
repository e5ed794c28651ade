#pragma once
#include "tests/codec/codec_toolbox.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tvg/properties.hpp>

// Streams of meshes that have more than connectivity.
namespace tvg::test {

/// A sequence and what its mesh has beside.
class PropertySource final : public FrameSource {
 public:
  PropertySource(const Sequence& sequence, const MeshProperties& properties)
      : frames_(sequence), properties_(properties) {}

  const Mesh& mesh() const override { return frames_.mesh(); }
  const MeshProperties& properties() const override { return properties_; }
  std::optional<std::uint64_t> frame_count() const override { return frames_.frame_count(); }
  Result<bool> read_frame(std::span<float> positions) override { return frames_.read_frame(positions); }
  bool rewind() override { return frames_.rewind(); }

 private:
  SequenceSource frames_;
  const MeshProperties& properties_;
};

/// What a face has that its order and first corner do not change.
struct FaceRecord {
  std::array<std::vector<float>, 3> corners;  ///< vertex, then all values, the smallest first
  Part part;

  auto key() const { return std::tie(corners, part.object, part.group, part.material); }
  bool operator<(const FaceRecord& other) const { return key() < other.key(); }
  bool operator==(const FaceRecord& other) const { return key() == other.key(); }
};

inline std::vector<float> corner_record(const Mesh& mesh, const MeshProperties& properties,
                                        std::size_t corner) {
  const std::uint32_t vertex = mesh.faces[corner / 3][corner % 3];
  std::vector<float> record = {static_cast<float>(vertex)};
  for (const Attribute& attribute : properties.attributes) {
    std::size_t value = vertex;
    if (attribute.domain == AttributeDomain::kCorner) value = attribute.corners[corner];
    if (attribute.domain == AttributeDomain::kPart) value = properties.face_parts[corner / 3];
    for (std::size_t c = 0; c < attribute.components; ++c)
      record.push_back(attribute.values[value * attribute.components + c]);
  }
  return record;
}

/// Of each face, sorted.
inline std::vector<FaceRecord> face_records(const Mesh& mesh, const MeshProperties& properties) {
  std::vector<FaceRecord> records(mesh.faces.size());
  for (std::size_t f = 0; f < records.size(); ++f) {
    auto& corners = records[f].corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = corner_record(mesh, properties, 3 * f + c);
    auto best = corners;
    for (int turn = 0; turn < 2; ++turn) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      best = std::min(best, corners);
    }
    corners = best;
    if (!properties.parts.empty()) records[f].part = properties.parts[properties.face_parts[f]];
  }
  std::sort(records.begin(), records.end());
  return records;
}

/// What the first mesh of a stream comes back as.
struct DecodedProperties {
  Mesh mesh;
  MeshProperties properties;
  Error error;
  bool complete = false;
};

inline DecodedProperties decode_properties_of(const Stream& stream, const DecoderLimits& limits = {}) {
  Decoder decoder(limits);
  decoder.push(stream);
  decoder.finish();
  DecodedProperties result;
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kMesh:
        result.mesh = decoder.mesh();
        result.properties = decoder.properties();
        break;
      case Decoder::Event::kDamage:
        result.error = decoder.damage().error;
        break;
      case Decoder::Event::kError:
        result.error = decoder.error();
        return result;
      case Decoder::Event::kEnd:
        result.complete = true;
        return result;
      default:
        break;
    }
  }
}

inline Attribute attribute_of(std::string name, AttributeKind kind, AttributeDomain domain,
                              std::uint32_t components, int bits = Attribute::kExact) {
  Attribute attribute;
  attribute.name = std::move(name);
  attribute.kind = kind;
  attribute.domain = domain;
  attribute.components = components;
  attribute.bits = bits;
  return attribute;
}

/// Values by vertex for most corners, and others where a seam is.
inline Attribute random_corners(Attribute attribute, const Mesh& mesh, double seams, std::mt19937& random) {
  std::uniform_real_distribution<float> value(0, 1);
  std::bernoulli_distribution apart(seams);
  const auto add = [&] {
    for (std::size_t c = 0; c < attribute.components; ++c) attribute.values.push_back(value(random));
  };
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) add();
  for (const Face& face : mesh.faces) {
    for (const std::uint32_t v : face) {
      attribute.corners.push_back(apart(random) ? static_cast<std::uint32_t>(attribute.value_count()) : v);
      if (attribute.corners.back() != v) add();
    }
  }
  return attribute;
}

inline Attribute random_values(Attribute attribute, std::size_t count, std::mt19937& random) {
  std::normal_distribution<float> value(0, 100);
  for (std::size_t i = 0; i < count * attribute.components; ++i) attribute.values.push_back(value(random));
  return attribute;
}

}  // namespace tvg::test
