#include "encoder/importers/open_source.hpp"
#include "tests/importers/sample_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// What sources say of attributes, parts, materials and times: which change, and what the frames have.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class SourceProperties : public ::testing::Test {
 protected:
  OpenedSource open(const std::vector<std::string>& names, SourceSpec spec = {}) const {
    for (const std::string& name : names) spec.inputs.push_back(folder_.path(name));
    return open_source(spec);
  }

  /// A square of two triangles with these `vt` and `vn` lines and faces.
  void write(const std::string& name, const std::string& lines, const std::string& z = "0") const {
    folder_.write(name, "v 0 0 " + z + "\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + lines);
  }

  static std::vector<float> values_of_next(FrameSource& source, std::size_t attribute) {
    FramePositions positions(3 * std::size_t{source.mesh().vertex_count});
    const Result<bool> read = source.read_frame(positions);
    EXPECT_TRUE(read && *read);
    const std::span<const float> values = source.animated_values(attribute);
    return {values.begin(), values.end()};
  }

  TemporaryFolder folder_;
};

const std::string kUv = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST_F(SourceProperties, WhatIsTheSameInAllFilesIsStaticWhateverItsIndices) {
  write("f_1.obj", kUv + "vt 0.5 0\nf 1/1 2/2 3/3\nf 1/5 3/3 4/4\n");
  write("f_2.obj", "vt 0.5 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 3/4 1/1 4/5\nf 1/2 2/3 3/4\n", "1");
  // The second file has its triangles in another order, too, one turned inside out: that is another mesh.
  write("f_2.obj", "vt 0.5 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 3/4 4/5 1/1\nf 1/2 2/3 3/4\n", "1");
  const OpenedSource opened = open({"f_%d.obj"});
  const MeshProperties& properties = opened.source->properties();
  ASSERT_THAT(properties.attributes, SizeIs(1));
  EXPECT_FALSE(properties.attributes[0].animated);
  EXPECT_THAT(properties.attributes[0].corners, ElementsAre(0, 1, 2, 4, 2, 3));
  const Frames frames = read_all(*opened.source);
  EXPECT_FALSE(frames.error);
  EXPECT_THAT(frames.frames, SizeIs(2));
}

TEST_F(SourceProperties, WhatChangesIsAnimatedWithTheSeamsOfAllFiles) {
  write("f_1.obj", "vt 0 0\nvt 1 1\nf 1/1 2/2 3/2\nf 1/1 3/2 4/1\n");
  write("f_2.obj", "vt 0 0\nvt 0.25 1\nvt 0.5 0\nf 1/1 2/2 3/2\nf 1/3 3/2 4/3\n");
  const OpenedSource opened = open({"f_%d.obj"});
  const MeshProperties& properties = opened.source->properties();
  ASSERT_THAT(properties.attributes, SizeIs(1));
  const Attribute& uv = properties.attributes[0];
  EXPECT_TRUE(uv.animated);
  EXPECT_EQ(uv.domain, AttributeDomain::kCorner);
  EXPECT_THAT(uv.corners, ElementsAre(0, 1, 2, 3, 2, 4));
  EXPECT_EQ(uv.value_count(), 5U);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("texture coordinates change from frame to frame")));
  for (int pass = 0; pass < 2; ++pass) {
    EXPECT_THAT(values_of_next(*opened.source, 0), ElementsAre(0, 0, 1, 1, 1, 1, 0, 0, 0, 0));
    EXPECT_THAT(values_of_next(*opened.source, 0), ElementsAre(0, 0, 0.25F, 1, 0.25F, 1, 0.5F, 0, 0.5F, 0));
    EXPECT_TRUE(opened.source->rewind());
  }
}

TEST_F(SourceProperties, ChangesThatNoFileForetoldAreSaidToBeAnotherMesh) {
  const std::string faces = "f 1/1 2/2 3/3 4/4\n";
  for (int i = 1; i <= 7; ++i)
    write("f_" + std::to_string(i) + ".obj", (i == 5 ? "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 0.5\n" : kUv) + faces);
  const OpenedSource opened = open({"f_%d.obj"});
  EXPECT_FALSE(opened.source->properties().attributes[0].animated);
  const Frames frames = read_all(*opened.source);
  EXPECT_THAT(frames.frames, SizeIs(4));
  ASSERT_TRUE(frames.error);
  EXPECT_THAT(frames.error->message, HasSubstr("has other texture coordinates than"));
}

TEST_F(SourceProperties, NormalsThatFacesGiveAreLeftOutUnlessAskedFor) {
  for (int i = 1; i <= 3; ++i) write("f_" + std::to_string(i) + ".obj", "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n");
  const OpenedSource dropped = open({"f_%d.obj"});
  EXPECT_THAT(dropped.source->properties().attributes, IsEmpty());
  EXPECT_THAT(dropped.source->properties().polygons, SizeIs(1));
  EXPECT_THAT(dropped.notes, Contains(HasSubstr("they are what the faces give, shaded smoothly")));
  SourceSpec keep;
  keep.sequence.properties.normals = NormalsChoice::kKeep;
  const OpenedSource kept = open({"f_%d.obj"}, keep);
  ASSERT_THAT(kept.source->properties().attributes, SizeIs(1));
  SourceSpec none;
  none.sequence.properties.wanted = false;
  EXPECT_TRUE(open({"f_%d.obj"}, none).source->properties().empty());
}

TEST_F(SourceProperties, NormalsThatSayMoreAreKept) {
  write("a.obj", "vn 0.6 0 0.8\nf 1//1 2//1 3//1 4//1\n");
  EXPECT_THAT(open({"a.obj"}).source->properties().attributes, SizeIs(1));
  folder_.write("a.pc2", pc2_bytes(4, 3, 3));
  const OpenedSource cached = open({"a.obj", "a.pc2"});
  EXPECT_THAT(cached.source->properties().attributes, IsEmpty());
  EXPECT_THAT(cached.notes, Contains(HasSubstr("those of its own pose")));
}

TEST_F(SourceProperties, MaterialsComeFromTheMaterialFile) {
  folder_.write("skin.png", "\x89PNG picture");
  folder_.write(
      "m.mtl",
      "# made by hand\nnewmtl red\nKd 0.8 0.1 0.1\nd 0.5\nNs 250\nmap_Kd -s 1 1 1 -clamp on skin.png\n"
      "illum 2\nnewmtl red\nKd 0 0 0\nnewmtl lamp\nKe 1 1 1\n");
  write("a.obj", "mtllib m.mtl\nmtllib gone.mtl\nusemtl red\nf 1 2 3\nusemtl unknown\nf 1 3 4\n");
  folder_.write("a.pc2", pc2_bytes(4, 3, 3));
  SourceSpec spec;
  spec.sequence.properties.embed_textures = true;
  for (const std::vector<std::string>& inputs : {std::vector<std::string>{"a.obj", "a.pc2"}, {"a.obj"}}) {
    const OpenedSource opened = open(inputs, spec);
    EXPECT_THAT(opened.source->properties().parts, SizeIs(2));
    const std::span<const NamedData> data = opened.source->data();
    ASSERT_THAT(data, SizeIs(2));
    EXPECT_EQ(data[0].name, "materials");
    EXPECT_EQ(data[1].name, "image/skin.png");
    EXPECT_THAT(data[1].bytes, SizeIs(12));
    const auto json = nlohmann::json::parse(data[0].bytes);
    ASSERT_EQ(json["materials"].size(), 3U);
    EXPECT_EQ(json["materials"][0]["name"], "red");
    EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"],
              nlohmann::json({0.8, 0.1, 0.1, 0.5}));
    EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"], 0.5);
    EXPECT_EQ(json["materials"][0]["alphaMode"], "BLEND");
    EXPECT_EQ(json["materials"][0]["extras"]["mtl"].size(), 5U);
    EXPECT_EQ(json["materials"][1]["emissiveFactor"], nlohmann::json({1.0, 1.0, 1.0}));
    EXPECT_EQ(json["materials"][2]["name"], "unknown");
    EXPECT_EQ(json["images"][0]["extras"]["data"], "image/skin.png");
    EXPECT_EQ(json["textures"][0]["sampler"], 0);
    EXPECT_THAT(opened.notes, Contains(HasSubstr("a second material 'red' is left out")));
    EXPECT_THAT(opened.notes, Contains(HasSubstr("gone.mtl is not there")));
  }
  const auto named = nlohmann::json::parse(open({"a.obj"}).source->data()[0].bytes);
  EXPECT_EQ(named["images"][0]["uri"], "skin.png");
}

TEST_F(SourceProperties, TimesOfACacheAreKept) {
  folder_.write("a.obj", sample_obj());
  std::string even = mdd_bytes(4, 4, 4, 0.04);
  ByteString times(true);
  for (const float time : {0.5F, 0.54F, 0.58F, 0.62F}) times.add(time);
  folder_.write("a.mdd", even.replace(8, 16, times.bytes()));
  const OpenedSource opened = open({"a.obj", "a.mdd"});
  EXPECT_EQ(opened.source->metadata().at("fps"), "25");
  EXPECT_EQ(opened.source->metadata().at("start"), "0.5");
  EXPECT_THAT(opened.source->data(), IsEmpty());
  ByteString uneven(true);
  for (const float time : {0.0F, 0.5F, 0.75F, 4.0F}) uneven.add(time);
  folder_.write("a.mdd", even.replace(8, 16, uneven.bytes()));
  SourceSpec part;
  part.frames = FrameRange{1, 2};
  const OpenedSource cut = open({"a.obj", "a.mdd"}, part);
  ASSERT_THAT(cut.source->data(), SizeIs(1));
  EXPECT_EQ(cut.source->data()[0].name, "times");
  ByteString expected(false);
  expected.add(0.5).add(0.75);
  const std::vector<std::uint8_t>& bytes = cut.source->data()[0].bytes;
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), expected.bytes());
  SourceSpec rated;
  rated.scene.fps = "10";
  const OpenedSource even_again = open({"a.obj", "a.mdd"}, rated);
  EXPECT_THAT(even_again.source->data(), IsEmpty());
  EXPECT_THAT(even_again.notes, Contains(HasSubstr("give way to --fps")));
}

}  // namespace
}  // namespace tvg::cli
