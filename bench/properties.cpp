#include "codecs/in_memory.hpp"
#include "encoder/importers/open_source.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/geometry.hpp>
#include <tvg/survey.hpp>

// tvg_properties: texture coordinates and normals of textured models, and captured volumes, beside Draco.
namespace tvg::bench {
namespace {

using draco::GeometryAttribute;

constexpr int kPositionBits = 11;
constexpr int kTexcoordBits = 12;
constexpr int kNormalBits = 10;

/// One mesh with the positions of one frame.
struct Model {
  Mesh mesh;
  FramePositions positions;
  MeshProperties properties;
};

/// What all frames lie in, as an encoder is told it.
struct Cube {
  std::array<float, 3> origin{};
  float edge = 0;
};

/// [face][corner]: the value of each corner, one after the other.
std::vector<float> at_corners(const Mesh& mesh, const Attribute& attribute) {
  std::vector<float> values;
  for (std::size_t corner = 0; corner < 3 * mesh.faces.size(); ++corner) {
    const std::size_t value =
        attribute.corners.empty() ? mesh.faces[corner / 3][corner % 3] : attribute.corners[corner];
    const auto begin = attribute.values.begin() + static_cast<std::ptrdiff_t>(value * attribute.components);
    values.insert(values.end(), begin, begin + attribute.components);
  }
  return values;
}

/// The bytes of a mesh in Draco: edgebreaker, the slowest and smallest speed; vertices that agree in
/// everything are one.
std::size_t draco_bytes(const Model& model, const Attribute* attribute, const std::optional<Cube>& cube) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(model.mesh.faces.size()));
  const int position_id = builder.AddAttribute(GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  int id = -1;
  std::vector<float> values;
  if (attribute != nullptr) {
    id = builder.AddAttribute(
        attribute->kind == AttributeKind::kNormal ? GeometryAttribute::NORMAL : GeometryAttribute::TEX_COORD,
        static_cast<std::int8_t>(attribute->components), draco::DT_FLOAT32);
    values = at_corners(model.mesh, *attribute);
  }
  for (std::size_t f = 0; f < model.mesh.faces.size(); ++f) {
    const draco::FaceIndex face(static_cast<std::uint32_t>(f));
    const auto place = [&](int corner) { return &model.positions[3 * model.mesh.faces[f][corner]]; };
    builder.SetAttributeValuesForFace(position_id, face, place(0), place(1), place(2));
    if (attribute == nullptr) continue;
    const float* const first = &values[3 * f * attribute->components];
    builder.SetAttributeValuesForFace(id, face, first, first + attribute->components,
                                      first + 2 * attribute->components);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  if (!mesh) throw std::runtime_error("Draco takes no such mesh");
  draco::Encoder encoder;
  encoder.SetSpeedOptions(0, 0);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  if (cube) {
    encoder.SetAttributeExplicitQuantization(GeometryAttribute::POSITION, kPositionBits, 3,
                                             cube->origin.data(), cube->edge);
  } else {
    encoder.SetAttributeQuantization(GeometryAttribute::POSITION, kPositionBits);
  }
  encoder.SetAttributeQuantization(GeometryAttribute::TEX_COORD, kTexcoordBits);
  encoder.SetAttributeQuantization(GeometryAttribute::NORMAL, kNormalBits);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("Draco failed");
  return buffer.size();
}

/// A frame with its mesh and some of its attributes.
class ModelSource final : public FrameSource {
 public:
  ModelSource(const Model& model, MeshProperties properties)
      : model_(model), properties_(std::move(properties)) {}

  const Mesh& mesh() const override { return model_.mesh; }
  const MeshProperties& properties() const override { return properties_; }
  std::optional<std::uint64_t> frame_count() const override { return 1; }
  Result<bool> read_frame(std::span<float> positions) override {
    if (std::exchange(read_, true)) return false;
    std::copy(model_.positions.begin(), model_.positions.end(), positions.begin());
    return true;
  }
  bool rewind() override {
    read_ = false;
    return true;
  }

 private:
  const Model& model_;
  MeshProperties properties_;
  bool read_ = false;
};

EncodeOptions options() {
  EncodeOptions options;
  options.fine_bits = options.coarse_bits = kPositionBits;
  options.attribute_bits = {kTexcoordBits, kNormalBits, 8, 0};
  return options;
}

/// What an attribute takes in the stream of its model.
std::uint64_t tvg_bytes(const Model& model, const Attribute& attribute) {
  ModelSource source(model, {{attribute}, {}, {}, {}});
  const std::vector<std::uint8_t> bytes = encode_to_memory(source, options());
  const auto read = [&bytes](std::uint64_t offset, std::span<std::uint8_t> out) -> Result<std::size_t> {
    const std::size_t count = std::min<std::uint64_t>(out.size(), bytes.size() - offset);
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), count, out.begin());
    return count;
  };
  const Result<StreamSurvey> surveyed = survey(read, bytes.size());
  if (!surveyed) throw std::runtime_error(surveyed.error().describe());
  return surveyed->meshes.at(0).parts.attributes_bytes;
}

std::unique_ptr<FrameSource> open(const std::string& path) {
  cli::SourceSpec spec{{path}};
  spec.sequence.properties.normals = cli::NormalsChoice::kKeep;
  spec.scene.properties.normals = cli::NormalsChoice::kKeep;
  return cli::open_source(spec).source;
}

/// The next frame with what its mesh has; nothing at the end.
std::optional<Model> next_model(FrameSource& source) {
  Model model;
  for (;;) {
    const Result<SourceStep> step = read_step(source, model.positions);
    if (!step) throw std::runtime_error(step.error().describe());
    if (*step == SourceStep::kMesh) continue;
    if (*step == SourceStep::kEnd) return std::nullopt;
    model.mesh = source.mesh();
    model.properties = source.properties();
    return model;
  }
}

/// The first attribute of a kind that corners or vertices have, if any.
const Attribute* first_of(const MeshProperties& properties, AttributeKind kind, std::uint32_t components) {
  const auto found = std::find_if(properties.attributes.begin(), properties.attributes.end(),
                                  [&](const Attribute& attribute) {
                                    return attribute.kind == kind && attribute.components == components &&
                                           attribute.domain != AttributeDomain::kPart && !attribute.animated;
                                  });
  return found == properties.attributes.end() ? nullptr : &*found;
}

struct Pair {
  std::uint64_t draco = 0, tvg = 0;

  void add(const Pair& other) {
    draco += other.draco;
    tvg += other.tvg;
  }
  void print() const {
    if (draco == 0) {
      std::printf("          -          -      -");
    } else {
      std::printf(" %10llu %10llu %6.3f", static_cast<unsigned long long>(draco),
                  static_cast<unsigned long long>(tvg),
                  static_cast<double>(tvg) / static_cast<double>(draco));
    }
  }
};

Pair attribute_pair(const Model& model, const Attribute* attribute) {
  if (attribute == nullptr) return {};
  return {draco_bytes(model, attribute, {}) - draco_bytes(model, nullptr, {}), tvg_bytes(model, *attribute)};
}

void compare_models(const std::vector<std::string>& paths) {
  std::printf("bytes of texture coordinates (%d bits) and of normals (%d bits)\n", kTexcoordBits,
              kNormalBits);
  std::printf("%-28s %8s %10s %10s %6s %10s %10s %6s\n", "model", "faces", "Draco", "TVG", "", "Draco", "TVG",
              "");
  Pair texcoords, normals;
  for (const std::string& path : paths) {
    const std::optional<Model> model = next_model(*open(path));
    if (!model) continue;
    const Pair texcoord = attribute_pair(*model, first_of(model->properties, AttributeKind::kTexcoord, 2));
    const Pair normal = attribute_pair(*model, first_of(model->properties, AttributeKind::kNormal, 3));
    std::printf("%-28s %8zu", std::filesystem::path(path).filename().c_str(), model->mesh.faces.size());
    texcoord.print();
    normal.print();
    std::printf("\n");
    texcoords.add(texcoord);
    normals.add(normal);
  }
  std::printf("%-28s %8s", "sum", "");
  texcoords.print();
  normals.print();
  std::printf("\n");
}

/// A sequence whose frames have meshes of their own: whole streams, on one lattice.
Pair captured_pair(const std::string& path, std::uint64_t& frames) {
  const std::unique_ptr<FrameSource> source = open(path);
  std::vector<Model> models;
  BoundingBox box;
  while (std::optional<Model> model = next_model(*source)) {
    box.extend(model->positions);
    models.push_back(std::move(*model));
  }
  frames = models.size();
  Cube cube{{}, static_cast<float>(box.largest_extent())};
  for (std::size_t axis = 0; axis < 3; ++axis) cube.origin[axis] = static_cast<float>(box.low()[axis]);
  Pair pair;
  for (const Model& model : models) pair.draco += draco_bytes(model, nullptr, cube);
  cli::SourceSpec spec{{path}};
  spec.sequence.properties.wanted = false;
  const std::unique_ptr<FrameSource> bare = cli::open_source(spec).source;
  EncodeOptions of_volume = options();
  of_volume.suit_captured = true;
  pair.tvg = encode_to_memory(*bare, of_volume).size();
  return pair;
}

void compare_captured(const std::vector<std::string>& paths) {
  std::printf("bytes of captured volumes, positions of %d bits\n", kPositionBits);
  std::printf("%-28s %8s %10s %10s\n", "sequence", "frames", "Draco", "TVG");
  for (const std::string& path : paths) {
    std::uint64_t frames = 0;
    const Pair pair = captured_pair(path, frames);
    std::printf("%-28s %8llu", std::filesystem::path(path).filename().c_str(),
                static_cast<unsigned long long>(frames));
    pair.print();
    std::printf("\n");
  }
}

}  // namespace
}  // namespace tvg::bench

int main(int argc, char** argv) {
  CLI::App app{"What meshes have beside positions, and captured volumes, in TVG and in Draco."};
  std::vector<std::string> models, captured;
  app.add_option("models", models, "mesh files or scenes with texture coordinates or normals");
  app.add_option("--captured", captured,
                 "folders or patterns of mesh files, each frame with a mesh of its own");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!models.empty()) tvg::bench::compare_models(models);
    if (!captured.empty()) tvg::bench::compare_captured(captured);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tvg_properties: %s\n", error.what());
    return 1;
  }
}
