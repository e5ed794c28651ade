#include "encoder/importers/open_source.hpp"
#include "tests/exporters/whole_mesh.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <bit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// What glTF has no word for comes back from the files that are written here.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;
using ::testing::Pair;

class OwnGltf : public ::testing::Test {
 protected:
  /// What is read of the whole mesh after it was written with `data`.
  OpenedSource round_trip(const std::vector<NamedData>& data = {}, const Metadata& metadata = {},
                          const SourceSpec& wanted = {}) const {
    const auto sink = open_sink(folder_.path("a.glb"), {});
    for (const NamedData& each : data) sink->add_data(each);
    whole_.write(*sink, 3, metadata);
    SourceSpec spec = wanted;
    spec.inputs = {folder_.path("a.glb")};
    return open_source(spec);
  }

  static NamedData times(const std::vector<double>& seconds) {
    NamedData data{"times", {}};
    for (const double time : seconds) {
      const auto bits = std::bit_cast<std::uint64_t>(time);
      for (int byte = 0; byte < 8; ++byte)
        data.bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * byte)));
    }
    return data;
  }

  TemporaryFolder folder_;
  WholeMesh whole_;
};

TEST_F(OwnGltf, UnevenTimesComeBack) {
  const NamedData written = times({0, 0.25, 0.375});
  const OpenedSource opened = round_trip({written});
  ASSERT_EQ(opened.source->data().size(), 2U);
  EXPECT_EQ(opened.source->data()[1], written);
  EXPECT_EQ(opened.source->frame_count(), 3U);
  EXPECT_THAT(opened.source->metadata(), Not(Contains(Key("fps"))));
}

TEST_F(OwnGltf, ARateThatIsAskedForGoesBeforeTheFramesOwn) {
  SourceSpec spec;
  spec.scene.fps = "50";
  const OpenedSource opened = round_trip({}, {{"fps", "25"}}, spec);
  EXPECT_EQ(opened.source->frame_count(), 5U);
  EXPECT_THAT(opened.source->metadata(), Contains(Pair("fps", "50")));
}

TEST_F(OwnGltf, MetadataComeBackButForWhatNodesSay) {
  const OpenedSource opened =
      round_trip({}, {{"fps", "24"}, {"name", "squares"}, {"author", "me"}, {"up", "z"}});
  EXPECT_EQ(opened.source->metadata(),
            (Metadata{{"author", "me"}, {"fps", "24"}, {"name", "squares"}, {"units", "m"}, {"up", "y"}}));
}

TEST_F(OwnGltf, NamesOfAttributesAndNumbersOfPartsComeBack) {
  whole_.properties.attributes[0].name = "UVMap";
  whole_.add(AttributeKind::kGeneric, 1, {0, 1, 2, 3, 4, 5}, "heat");
  whole_.add(AttributeKind::kGeneric, 1, {1, 2}, "smoothing_group").domain = AttributeDomain::kPart;
  const OpenedSource opened = round_trip();
  std::vector<std::string> names;
  for (const Attribute& attribute : opened.source->properties().attributes) names.push_back(attribute.name);
  EXPECT_THAT(names, ElementsAre("UVMap", "heat", "smoothing_group"));
  EXPECT_THAT(opened.source->properties().attributes.back().values, ElementsAre(1, 2));
}

TEST_F(OwnGltf, PolygonsThatNoLongerFitAreTriangles) {
  for (const char* const runs : {"[1, 5]", "[2, 4]", "[2147483647, 3]", "[-1, 4]", "[1]", "\"quads\""}) {
    whole_.write(*open_sink(folder_.path("a.gltf"), {}), 2);
    auto document = nlohmann::json::parse(folder_.read("a.gltf"));
    for (auto& primitive : document["meshes"][0]["primitives"])
      primitive["extras"]["polygons"] = nlohmann::json::parse(runs);
    folder_.write("a.gltf", document.dump());
    EXPECT_THAT(open_source({{folder_.path("a.gltf")}}).source->properties().polygons, IsEmpty()) << runs;
  }
}

TEST_F(OwnGltf, LinearColoursThatAreNoBytesGetMoreBits) {
  whole_.add_colours();
  EXPECT_EQ(round_trip().source->properties().attributes[0].bits, Attribute::kBitsOfKind);
  whole_.properties.attributes.back().values[4] = 0.0125F;
  EXPECT_EQ(round_trip().source->properties().attributes[0].bits, 12);
}

TEST_F(OwnGltf, MaterialsBecomeValid) {
  const NamedData materials =
      named_data("materials", R"({"materials": [{"name": "red", "emissiveFactor": [4, 2, 0],
      "normalTexture": {"scale": 1}, "alphaMode": 3, "pbrMetallicRoughness": {"roughnessFactor": -2.2,
      "baseColorFactor": [2, 0.5, 0, 1], "metallicFactor": "no"}}, {"name": "blue", "extensions": {"EXT_a": 1},
      "pbrMetallicRoughness": []}], "images": [{"uri": "C:\\work\\wood.png"}]})");
  whole_.write(
      *[&] {
        auto sink = open_sink(folder_.path("a.gltf"), {});
        sink->add_data(materials);
        return sink;
      }(),
      1);
  const auto document = nlohmann::json::parse(folder_.read("a.gltf"));
  EXPECT_EQ(document["materials"], nlohmann::json::parse(R"([{"name": "red", "emissiveFactor": [1, 0.5, 0],
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}},
      "pbrMetallicRoughness": {"roughnessFactor": 0, "baseColorFactor": [1, 0.5, 0, 1]}}, {"name": "blue"}])"));
  EXPECT_EQ(document["images"][0]["uri"], "wood.png");
  EXPECT_EQ(document["extensionsUsed"], nlohmann::json({"KHR_materials_emissive_strength"}));
}

}  // namespace
}  // namespace tvg::cli
