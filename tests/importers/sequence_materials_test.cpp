#include "encoder/importers/open_source.hpp"
#include "tests/importers/sample_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// Materials of a sequence whose files have their own.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class SequenceMaterials : public ::testing::Test {
 protected:
  /// Fans of `corners` corners, so that each file has a mesh of its own.
  void write(const std::string& name, const std::string& library, int corners) const {
    std::string text = "mtllib " + library + "\n", face = "usemtl skin\nf";
    for (int i = 0; i < corners; ++i) {
      text += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
      face += " " + std::to_string(i + 1);
    }
    folder_.write(name, text + face + "\n");
  }

  /// The names of parts' materials in each mesh that comes.
  static std::vector<std::string> names_of(FrameSource& source) {
    std::vector<std::string> names;
    for (;;) {
      names.push_back(source.properties().parts.at(0).material);
      FramePositions positions(3 * std::size_t{source.mesh().vertex_count});
      EXPECT_TRUE(source.read_frame(positions));
      const Result<bool> more = source.read_frame(positions);
      if (more) return names;
      EXPECT_TRUE(source.begin_next_mesh());
    }
  }

  static nlohmann::json materials_of(const FrameSource& source) {
    return nlohmann::json::parse(source.data()[0].bytes)["materials"];
  }

  TemporaryFolder folder_;
};

TEST_F(SequenceMaterials, ThoseOfLaterFilesGetNamesOfTheirOwn) {
  folder_.write("1.mtl", "newmtl skin\nmap_Kd 1.png\n");
  folder_.write("2.mtl", "newmtl skin\nmap_Kd 2.png\n");
  folder_.write("3.mtl", "newmtl skin\nmap_Kd 1.png\n");
  for (int i = 1; i <= 3; ++i) write("f_" + std::to_string(i) + ".obj", std::to_string(i) + ".mtl", 2 + i);
  const OpenedSource opened = open_source({{folder_.path("f_%d.obj")}});
  // The third says what the first says.
  const nlohmann::json materials = materials_of(*opened.source);
  ASSERT_THAT(materials, SizeIs(2));
  EXPECT_EQ(materials[1]["name"], "skin 2");
  EXPECT_THAT(names_of(*opened.source), ElementsAre("skin", "skin 2", "skin"));
}

TEST_F(SequenceMaterials, TexturesOfFoldersAreEmbeddedUnderNamesOfTheirOwn) {
  for (const std::string i : {"1", "2"}) {
    folder_.write(i + "/m.mtl", "newmtl skin\nmap_Kd t.png\n");
    folder_.write(i + "/t.png", "picture " + i);
    write(i + "/mesh.obj", "m.mtl", i == "1" ? 3 : 4);
  }
  SourceSpec spec{{folder_.path("%d/mesh.obj")}};
  spec.sequence.properties.embed_textures = true;
  const OpenedSource opened = open_source(spec);
  ASSERT_THAT(opened.source->data(), SizeIs(3));
  EXPECT_EQ(opened.source->data()[1].name, "image/t.png");
  EXPECT_EQ(opened.source->data()[2].name, "image/2/t.png");
  EXPECT_THAT(names_of(*opened.source), ElementsAre("skin", "skin 2"));
}

TEST_F(SequenceMaterials, MissingFilesOfLaterMeshesAreNotedOnce) {
  folder_.write("1.mtl", "newmtl skin\n");
  for (int i = 1; i <= 3; ++i) write("f_" + std::to_string(i) + ".obj", std::to_string(i) + ".mtl", 2 + i);
  const OpenedSource opened = open_source({{folder_.path("f_%d.obj")}});
  EXPECT_THAT(opened.notes, Contains(HasSubstr("material file 2.mtl is not there")));
  EXPECT_THAT(opened.notes, ::testing::Not(Contains(HasSubstr("3.mtl"))));
}

}  // namespace
}  // namespace tvg::cli
