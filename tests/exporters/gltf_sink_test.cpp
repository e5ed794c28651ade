#include "decoder/exporters/frame_sink.hpp"
#include "encoder/importers/open_source.hpp"
#include "tests/exporters/whole_mesh.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <bit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tvg::cli {
namespace {

using namespace testing;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A .glb taken apart.
struct Glb {
  json document;
  std::string buffer;

  explicit Glb(const std::string& bytes) {
    std::uint32_t sizes[4];
    std::memcpy(sizes, bytes.data() + 4, 16);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(sizes[1], bytes.size());
    document = json::parse(bytes.substr(20, sizes[2]));
    if (bytes.size() > 28 + sizes[2]) buffer = bytes.substr(28 + sizes[2]);
  }

  /// The floats of an accessor that is packed.
  std::vector<float> floats(const json& accessor_number) const {
    static const std::map<std::string, std::size_t> kComponents = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const json& accessor = document["accessors"][accessor_number.get<std::size_t>()];
    EXPECT_EQ(accessor["componentType"], 5126);
    const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<float> values(accessor["count"].get<std::size_t>() *
                              kComponents.at(accessor["type"].get<std::string>()));
    const std::size_t at = view["byteOffset"].get<std::size_t>() + accessor["byteOffset"].get<std::size_t>();
    std::memcpy(values.data(), buffer.data() + at, values.size() * 4);
    return values;
  }
};

class GltfSinkTest : public ::testing::Test {
 protected:
  Glb write(int frames, const SinkOptions& options = {}, const Metadata& metadata = {{"fps", "25"}}) {
    const auto sink = open_sink(folder_.path("a.glb"), options);
    for (const NamedData& data : data_) sink->add_data(data);
    whole_.write(*sink, frames, metadata);
    notes_ = sink->notes();
    return Glb(folder_.read("a.glb"));
  }

  TemporaryFolder folder_;
  WholeMesh whole_;
  std::vector<NamedData> data_;
  std::vector<std::string> notes_;
};

TEST_F(GltfSinkTest, SplitsVerticesAtSeamsAndTurnsTexcoordsOver) {
  const Glb glb = write(1);
  const json& primitives = glb.document["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_EQ(glb.floats(primitives[0]["attributes"]["POSITION"]),
            (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0, 1, 0, 0, 1, 1, 0}));
  EXPECT_EQ(glb.floats(primitives[0]["attributes"]["TEXCOORD_0"]),
            (std::vector<float>{0, 1, 0.5F, 1, 0.5F, 0, 0, 0, 1, 1, 1, 0, 0.75F, 1, 0.75F, 0}));
  EXPECT_EQ(primitives[0]["extras"], json::parse(R"({"object": "left", "group": "front", "polygons": [1, 4],
                                                      "names": {"TEXCOORD_0": ""}})"));
  EXPECT_EQ(glb.document["materials"], json::parse(R"([{"name": "red"}, {"name": "blue"}])"));
  EXPECT_EQ(primitives[1]["material"], 1);
  EXPECT_FALSE(glb.document.contains("animations"));
}

TEST_F(GltfSinkTest, FramesAreTargetsThatAClipGoesThrough) {
  const Glb glb = write(3);
  const json& mesh = glb.document["meshes"][0];
  EXPECT_EQ(mesh["weights"], json({0, 0}));
  ASSERT_EQ(mesh["primitives"][1]["targets"].size(), 2U);
  EXPECT_EQ(glb.floats(mesh["primitives"][1]["targets"][1]["POSITION"]),
            (std::vector<float>{2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 2, 2, 0, 0, 2, 0, 0}));
  const json& animation = glb.document["animations"][0];
  EXPECT_EQ(animation["channels"][0]["target"], json({{"node", 0}, {"path", "weights"}}));
  EXPECT_EQ(animation["samplers"][0]["interpolation"], "LINEAR");
  EXPECT_THAT(glb.floats(animation["samplers"][0]["input"]), ElementsAre(0, 0.04F, 0.08F));
  EXPECT_THAT(glb.floats(animation["samplers"][0]["output"]), ElementsAre(0, 0, 1, 0, 0, 1));
  SinkOptions steps;
  steps.gltf_steps = true;
  EXPECT_EQ(write(3, steps).document["animations"][0]["samplers"][0]["interpolation"], "STEP");
}

TEST_F(GltfSinkTest, IsReadBackFrameForFrame) {
  for (const bool quantized : {false, true}) {
    for (const std::string name : {"a.glb", "b.gltf"}) {
      SinkOptions options;
      options.gltf_quantized = quantized;
      const auto sink = open_sink(folder_.path(name), options);
      whole_.write(*sink, 4);
      SourceSpec spec{{folder_.path(name)}, {}};
      spec.scene.fps = "25";
      const OpenedSource opened = open_source(spec);
      EXPECT_EQ(opened.source->mesh(), whole_.mesh);
      const Frames result = read_all(*opened.source);
      ASSERT_EQ(result.frames.size(), 4U);
      // Steps of 16 bits over an extent of 5, half of which no vertex leaves.
      const float tolerance = quantized ? 0.5F * 5 / 32766 : 0;
      for (int frame = 0; frame < 4; ++frame) {
        const FramePositions expected = whole_.frame(frame);
        for (std::size_t i = 0; i < expected.size(); ++i)
          EXPECT_NEAR(result.frames[static_cast<std::size_t>(frame)][i], expected[i], tolerance + 1e-6F);
      }
    }
  }
  EXPECT_THAT(folder_.names(), ElementsAre("a.glb", "b.bin", "b.gltf"));
}

TEST_F(GltfSinkTest, QuantizedPositionsNeedTheirExtension) {
  SinkOptions options;
  options.gltf_quantized = true;
  const Glb glb = write(2, options);
  EXPECT_EQ(glb.document["extensionsRequired"], json({"KHR_mesh_quantization"}));
  const json& position =
      glb.document["accessors"]
                  [glb.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(position["componentType"], 5123);
}

TEST_F(GltfSinkTest, MaterialsComeWithTheirImages) {
  data_ = {two_materials(), named_data("image/wood.png", kPng)};
  const Glb glb = write(1);
  EXPECT_EQ(glb.document["materials"][0]["emissiveFactor"], json({0, 0, 0.25}));
  EXPECT_EQ(glb.document["textures"], json::parse(R"([{"source": 0}])"));
  const json& image = glb.document["images"][0];
  EXPECT_EQ(image["mimeType"], "image/png");
  EXPECT_FALSE(image.contains("uri"));
  const json& view = glb.document["bufferViews"][image["bufferView"].get<std::size_t>()];
  EXPECT_EQ(glb.buffer.substr(view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>()),
            kPng);
}

TEST_F(GltfSinkTest, TexturesWithoutTexcoordsOrImagesAreLeftOut) {
  data_ = {two_materials()};
  EXPECT_EQ(write(1).document["images"][0]["uri"], "wood.png");
  whole_.properties.attributes.clear();
  const Glb glb = write(1);
  EXPECT_FALSE(glb.document["materials"][0]["pbrMetallicRoughness"].contains("baseColorTexture"));
  EXPECT_THAT(notes_, ::testing::Contains(HasSubstr("no texture coordinates for them")));
}

TEST_F(GltfSinkTest, NormalsHaveLengthOneAndTargetsWhereTheyChange) {
  whole_.add(AttributeKind::kNormal, 3, {0, 0, 2, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 3, 4}).animated =
      true;
  const auto sink = open_sink(folder_.path("a.glb"), {});
  sink->begin_mesh(whole_.mesh, whole_.properties, {}, 2);
  std::vector<float> normals = whole_.properties.attributes[1].values;
  for (int i = 0; i < 2; ++i) {
    const std::vector<std::span<const float>> animated = {{}, normals};
    sink->write_frame(whole_.frame(i), animated);
    normals[2] = -1;
  }
  sink->finish();
  const Glb glb(folder_.read("a.glb"));
  const json& primitive = glb.document["meshes"][0]["primitives"][0];
  const std::vector<float> first = glb.floats(primitive["attributes"]["NORMAL"]);
  EXPECT_EQ(std::vector<float>(first.begin(), first.begin() + 6), (std::vector<float>{0, 0, 1, 0, 0, 1}));
  EXPECT_FLOAT_EQ(first[16], 0.6F);
  EXPECT_EQ(glb.document["accessors"][primitive["targets"][0]["NORMAL"].get<std::size_t>()]["min"],
            json({0, 0, -2}));
}

TEST_F(GltfSinkTest, AnotherMeshIsAnotherNodeInItsTime) {
  const auto sink = open_sink(folder_.path("a.glb"), {});
  whole_.add_colours();
  sink->begin_mesh(whole_.mesh, whole_.properties, {{"fps", "10"}}, 4);
  sink->write_frame(whole_.frame(0));
  sink->write_frame(whole_.frame(1));
  sink->begin_mesh({}, {}, {{"fps", "10"}}, 4);
  sink->write_frame({});
  sink->begin_mesh({3, {{0, 1, 2}}}, {}, {{"fps", "10"}}, 4);
  sink->write_frame(FramePositions{0, 0, 0, 1, 0, 0, 0, 1, 0});
  sink->finish();
  EXPECT_THAT(sink->notes(), ElementsAre(HasSubstr("the mesh changes: glTF has 3")));
  const Glb glb(folder_.read("a.glb"));
  EXPECT_EQ(glb.document["meshes"].size(), 2U);
  const json& nodes = glb.document["nodes"];
  ASSERT_EQ(nodes.size(), 4U);
  EXPECT_EQ(nodes[3]["children"], json({2}));
  EXPECT_EQ(nodes[3]["scale"], json({0, 0, 0}));
  const json& animation = glb.document["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 3U);
  EXPECT_EQ(animation["channels"][2]["target"], json({{"node", 3}, {"path", "scale"}}));
  EXPECT_THAT(glb.floats(animation["samplers"][1]["input"]), ElementsAre(0, 0.2F));
  EXPECT_THAT(glb.floats(animation["samplers"][2]["input"]), ElementsAre(0, 0.3F));
  EXPECT_THAT(glb.floats(animation["samplers"][2]["output"]), ElementsAre(0, 0, 0, 1, 1, 1));
}

TEST_F(GltfSinkTest, ANodeAboveBringsMetresAndYUp) {
  const Glb glb = write(1, {}, {{"up", "z"}, {"units", "cm"}, {"origin", "100 200 300"}});
  const json& root = glb.document["nodes"][1];
  EXPECT_EQ(glb.document["scenes"][0]["nodes"], json({1}));
  EXPECT_EQ(root["children"], json({0}));
  EXPECT_EQ(root["translation"], json({1.0, 3.0, -2.0}));
  EXPECT_EQ(root["scale"], json({0.01, 0.01, 0.01}));
  EXPECT_NEAR(root["rotation"][0].get<double>(), -0.70710678, 1e-8);
}

TEST_F(GltfSinkTest, ABufferOfAnotherProgramStaysAsItIs) {
  folder_.write("a.gltf", R"({"asset": {"version": "2.0", "generator": "another"}})");
  folder_.write("a.bin", "theirs");
  EXPECT_THROW(open_sink(folder_.path("a.gltf"), {}), ToolError);
  EXPECT_EQ(folder_.read("a.bin"), "theirs");
  for (int i = 0; i < 2; ++i) whole_.write(*open_sink(folder_.path("b.gltf"), {}), 2);
  EXPECT_THAT(folder_.names(), ElementsAre("a.bin", "a.gltf", "b.bin", "b.gltf"));
}

TEST_F(GltfSinkTest, LeavesNothingWhereItIsNotFinished) {
  for (const std::string name : {"a.glb", "a.gltf"}) {
    SinkOptions options;
    options.gltf_quantized = true;
    const auto sink = open_sink(folder_.path(name), options);
    sink->begin_mesh(whole_.mesh, whole_.properties, {}, 2);
    sink->write_frame(whole_.frame(0));
  }
  EXPECT_THAT(folder_.names(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace tvg::cli
