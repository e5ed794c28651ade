#include "property_streams.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace tvg::conformance {

namespace {

/// The frames of a sequence, and what their mesh has.
class PropertySource final : public SourceDecorator {
 public:
  PropertySource(const Sequence& sequence, const MeshProperties& properties)
      : SourceDecorator(std::make_unique<SequenceSource>(sequence)), properties_(properties) {}

  const MeshProperties& properties() const override { return properties_; }

 private:
  const MeshProperties& properties_;
};

/// Turns faces so that runs of neighbours are fans of at most `most` triangles, and returns those of two and
/// more.
std::vector<Polygon> make_fans(std::vector<Face>& faces, std::uint32_t most) {
  const auto turned_until = [](Face& face, std::uint32_t first, std::uint32_t second) {
    for (int turn = 0; turn < 3; ++turn) {
      if (face[0] == first && face[1] == second && face[2] != first && face[2] != second) return true;
      std::rotate(face.begin(), face.begin() + 1, face.end());
    }
    return false;
  };
  std::vector<Polygon> polygons;
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t end = first + 1;
    Face& face = faces[first];
    const bool is_face = face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
    for (int turn = 0; is_face && turn < 3 && end == first + 1; ++turn) {
      std::rotate(face.begin(), face.begin() + 1, face.end());
      while (end < faces.size() && end - first < most &&
             turned_until(faces[end], face[0], faces[end - 1][2]) && faces[end][2] != face[1])
        ++end;
    }
    if (end > first + 1) polygons.push_back({first, static_cast<std::uint32_t>(end - first + 2)});
    first = end;
  }
  return polygons;
}

/// An attribute of corners: value(vertex, chart) is shared by the corners that a vertex has in the faces of a
/// chart.
template <typename Value, typename Chart>
void set_corners(Attribute& attribute, const Mesh& mesh, const Chart& chart, const Value& value) {
  attribute.domain = AttributeDomain::kCorner;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::uint32_t v : mesh.faces[f]) {
      const auto [entry, is_new] =
          numbers.try_emplace({v, chart(f)}, static_cast<std::uint32_t>(numbers.size()));
      attribute.corners.push_back(entry->second);
      if (!is_new) continue;
      for (const float number : value(v, chart(f))) attribute.values.push_back(number);
    }
  }
}

Attribute attribute_of(std::string name, AttributeKind kind, std::uint32_t components, int bits) {
  Attribute attribute;
  attribute.name = std::move(name);
  attribute.kind = kind;
  attribute.components = components;
  attribute.bits = bits;
  return attribute;
}

Attribute texcoords(const Sequence& sequence, int bits) {
  Attribute attribute = attribute_of("", AttributeKind::kTexcoord, 2, bits);
  const FramePositions& at = sequence.frames[0];
  const std::size_t half = sequence.mesh.faces.size() / 2;
  set_corners(
      attribute, sequence.mesh, [half](std::size_t f) { return std::uint32_t{f < half}; },
      [&at](std::uint32_t v, std::uint32_t chart) {
        const float u = at[3 * v], w = at[3 * v + 1];
        return chart == 0 ? std::array{u, w} : std::array{4 - w, u / 2};
      });
  return attribute;
}

/// Of length 1 in float32, or none; every ninth face is shaded by itself.
Attribute normals(const Mesh& mesh, int bits) {
  constexpr std::array<std::array<float, 3>, 6> kNormals = {
      {{0, 0, 1}, {0, 0.6F, 0.8F}, {0.6F, 0, 0.8F}, {0, -0.28F, 0.96F}, {-0.8F, 0.6F, 0}, {0, 0, 0}}};
  Attribute attribute = attribute_of("", AttributeKind::kNormal, 3, bits);
  set_corners(
      attribute, mesh, [](std::size_t f) { return static_cast<std::uint32_t>(f % 9 == 8 ? f : 0); },
      [&kNormals](std::uint32_t v, std::uint32_t face) {
        return kNormals[face > 0 ? 4 : v % 29 == 28 ? 5 : v / 20 % 4];
      });
  return attribute;
}

Attribute colours(const Mesh& mesh, int bits) {
  Attribute attribute = attribute_of("Farbe \xC3\xA4", AttributeKind::kColour, 4, bits);
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    for (const std::uint32_t number : {v / 8 % 5, v % 3, v / 50, 4u})
      attribute.values.push_back(static_cast<float>(number) / 4);
  }
  return attribute;
}

Attribute numbers_of_vertices(const Sequence& sequence) {
  Attribute attribute = attribute_of("height", AttributeKind::kGeneric, 1, Attribute::kExact);
  for (std::uint32_t v = 0; v < sequence.mesh.vertex_count; ++v)
    attribute.values.push_back(v % 31 == 30 ? -0.0F : sequence.frames[0][3 * v + 2]);
  return attribute;
}

Attribute numbers_of_parts(std::size_t parts) {
  Attribute attribute = attribute_of("mass", AttributeKind::kGeneric, 3, 7);
  attribute.domain = AttributeDomain::kPart;
  for (std::size_t p = 0; p < parts; ++p) {
    for (const float number : {1.0F, 2.5F, -3.0F}) attribute.values.push_back(number * static_cast<float>(p));
  }
  return attribute;
}

/// Stripes of faces, some of which are alike, and of the last one a single face elsewhere.
void set_parts(MeshProperties& properties, std::size_t faces) {
  properties.parts = {
      {"flag", "upper", "silk"}, {"flag", "upper hem", "silk"}, {"", "upper", ""}, {"flag", "upper", "silk"}};
  for (std::size_t f = 0; f < faces; ++f)
    properties.face_parts.push_back(static_cast<std::uint32_t>(f == 7 ? 3 : f * 4 / faces));
}

/// All that a mesh can have; its faces are turned for the polygons.
MeshProperties all_properties(Sequence& sequence, bool exact) {
  MeshProperties properties;
  properties.polygons = make_fans(sequence.mesh.faces, 3);
  set_parts(properties, sequence.mesh.faces.size());
  properties.attributes = {texcoords(sequence, exact ? 0 : 6), normals(sequence.mesh, exact ? 0 : 5),
                           colours(sequence.mesh, exact ? 0 : 3), numbers_of_vertices(sequence),
                           numbers_of_parts(properties.parts.size())};
  return properties;
}

Stream encode_properties(std::string_view name, EncodeOptions options, bool exact = false) {
  Sequence sequence = corpus_sequence(name, 2);
  const MeshProperties properties = all_properties(sequence, exact);
  PropertySource source(sequence, properties);
  return encode_source(source, options);
}

/// All but the numbers of vertices change: some values in every frame but the third, which repeats the
/// second.
class AnimatedSource final : public FrameSource {
 public:
  AnimatedSource(const Sequence& sequence, const MeshProperties& properties)
      : frames_(sequence), properties_(properties), first_(properties.attributes) {
    for (Attribute& attribute : properties_.attributes) attribute.animated = attribute.name != "height";
  }

  const Mesh& mesh() const override { return frames_.mesh(); }
  const MeshProperties& properties() const override { return properties_; }
  std::span<const float> animated_values(std::size_t attribute) const override {
    return properties_.attributes[attribute].values;
  }
  std::optional<std::uint64_t> frame_count() const override { return frames_.frame_count(); }
  Result<bool> read_frame(std::span<float> positions) override {
    for (std::size_t a = 0; a < first_.size(); ++a) move(first_[a], properties_.attributes[a].values);
    if (read_ != 1) ++moved_;
    ++read_;
    return frames_.read_frame(positions);
  }
  bool rewind() override {
    read_ = moved_ = 0;
    return frames_.rewind();
  }

 private:
  /// Keeps the lengths of normals, and colours from 0 to 1.
  void move(const Attribute& first, std::vector<float>& values) const {
    if (first.name == "height") return;
    values = first.values;
    const std::size_t width = first.components;
    for (std::size_t i = 0; i < first.value_count(); ++i) {
      float* const value = values.data() + width * i;
      if (first.kind == AttributeKind::kNormal) {
        if (moved_ > 0 && i % 5 < moved_) std::swap(value[0], value[(i + moved_) % 3]);
      } else if (first.kind == AttributeKind::kColour) {
        value[0] = i % 3 < moved_ ? 1 - value[0] : value[0];
      } else {
        value[0] += static_cast<float>(moved_ * (i % 4)) / 8;
      }
    }
  }

  SequenceSource frames_;
  MeshProperties properties_;
  std::vector<Attribute> first_;
  std::size_t read_ = 0, moved_ = 0;
};

Stream encode_animated(const EncodeOptions& options) {
  Sequence sequence = corpus_sequence("cloth", 4);
  const MeshProperties properties = all_properties(sequence, false);
  AnimatedSource source(sequence, properties);
  return encode_source(source, options);
}

}  // namespace

Stream make_attributes() {
  return encode_properties("cloth", options_of(5, 5, Predictor::kElp, 50));
}

Stream make_attributes_shape() {
  return encode_properties("cloth", options_of(5, 5, Predictor::kPyramid, 50));
}

Stream make_attributes_exact() {
  EncodeOptions options;
  options.mode = Mode::kLossless;
  Sequence sequence = corpus_sequence("cloth", 1);
  MeshProperties properties = all_properties(sequence, true);
  properties.attributes.resize(2);
  PropertySource source(sequence, properties);
  return encode_source(source, options);
}

Stream make_attributes_soup() {
  EncodeOptions options = options_of(5, 5, Predictor::kPyramid, 50);
  options.keep_vertex_order = false;
  return encode_properties("soup", options);
}

Stream make_animated() {
  return encode_animated(options_of(5, 5, Predictor::kElp, 3));
}

Stream make_animated_shape() {
  return encode_animated(options_of(5, 5, Predictor::kPyramid, 50));
}

Stream make_animated_exact() {
  EncodeOptions options;
  options.mode = Mode::kLossless;
  Sequence sequence = corpus_sequence("cloth", 2);
  MeshProperties properties = all_properties(sequence, true);
  properties.attributes = {texcoords(sequence, 0)};
  AnimatedSource source(sequence, properties);
  return encode_source(source, options);
}

Stream make_shape() {
  Stream stream;
  EncodeOptions options = options_of(6, 6, Predictor::kShape, 1);
  options.max_meshes = 2;
  options.max_vertices = 231;
  options.max_faces = 355;
  options.max_property_bytes = 4096;
  Encoder encoder(options, [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  for (const std::string_view name : {"cloth", "soup"}) {
    Sequence sequence = corpus_sequence(name, 1);
    MeshProperties properties;
    properties.polygons = make_fans(sequence.mesh.faces, 12);
    Status status = encoder.set_mesh(sequence.mesh, {}, properties);
    if (status.ok()) status = encoder.add_frame(sequence.frames[0]);
    if (!status.ok()) stop(status.error().describe());
  }
  const auto report = encoder.finish();
  if (!report) stop(report.error().describe());
  return stream;
}

}  // namespace tvg::conformance
