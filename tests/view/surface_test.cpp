#include "player/view/surface.hpp"

#include "player/view/picture_file.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace tvg::player {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) {
  return {text.begin(), text.end()};
}

/// The file of a small picture.
std::vector<std::uint8_t> png(const cli::testing::TemporaryFolder& folder) {
  const std::string path = folder.path("made.png");
  write_png(path, {2, 1, {255, 0, 0, 255, 0, 255, 0, 255}});
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

ShownMaterials materials_of(std::string_view image, const std::string& folder,
                            const std::vector<std::uint8_t>& stored = {}) {
  ShownMaterials materials;
  const std::string json = R"({"materials": [{"name": "m", "pbrMetallicRoughness": {"baseColorFactor":
      [0.5, 2, "x"], "baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}], "images": [)" +
                           std::string(image) + "]}";
  materials.take({"materials", bytes_of(json)});
  if (!stored.empty()) materials.take({"image/a", stored});
  materials.make(folder);
  return materials;
}

TEST(Surface, PicturesOfAnyBytesAreReadOrRefused) {
  const cli::testing::TemporaryFolder folder;
  const std::vector<std::uint8_t> whole = png(folder);
  const std::optional<Image> read = decode_picture(whole);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->width, 2);
  EXPECT_EQ(read->pixels[5], 255);
  for (std::size_t size = 0; size + 12 < whole.size(); ++size)
    EXPECT_FALSE(decode_picture(std::span(whole).first(size))) << size;
  EXPECT_FALSE(decode_picture(bytes_of("\xff\xd8\xff\xe0 no picture at all")));
  EXPECT_FALSE(decode_picture(bytes_of("GIF89a")));
}

TEST(Surface, PicturesComeFromTheStreamOrFromItsFolderAndNowhereElse) {
  const cli::testing::TemporaryFolder folder;
  const std::vector<std::uint8_t> bytes = png(folder);
  folder.write("in/b c.png", std::string(bytes.begin(), bytes.end()));
  const std::string in = folder.path("in");
  const auto found = [&](std::string_view image, const std::string& where) {
    return materials_of(image, where, bytes).find("m")->texture != nullptr;
  };
  EXPECT_TRUE(found(R"({"extras": {"data": "image/a"}})", ""));
  EXPECT_TRUE(found(R"({"uri": "b%20c.png"})", in));
  EXPECT_TRUE(found(R"({"uri": "in\\b c.png"})", folder.path("")));
  EXPECT_FALSE(found(R"({"uri": "b%20c.png"})", ""));
  EXPECT_FALSE(found(R"({"uri": "../made.png"})", in));
  EXPECT_FALSE(found("{\"uri\": \"" + folder.path("made.png") + "\"}", in));
  EXPECT_FALSE(found("7", in));
  EXPECT_NE(materials_of(R"({"uri": "x.png"})", in).note().find("x.png"), std::string::npos);
}

TEST(Surface, WhatMaterialsSayWrongIsLeftOut) {
  const ShownMaterials materials = materials_of("{}", "");
  ASSERT_NE(materials.find("m"), nullptr);
  EXPECT_EQ(materials.find("m")->factor, (std::array<float, 4>{0.5F, 1, 1, 1}));
  EXPECT_EQ(materials.find("other"), nullptr);
  ShownMaterials broken;
  broken.take({"materials", bytes_of("{\"materials\": [")});
  broken.make("");
  EXPECT_TRUE(broken.empty());
}

/// Two faces at a right angle.
TEST(Surface, NormalsPartWhereThoseOfTheStreamDoAndMoveWithTheFrame) {
  const Mesh mesh{4, {{0, 1, 2}, {1, 0, 3}}};
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1};
  MeshProperties properties;
  EXPECT_EQ(make_surface(mesh, properties, {}), nullptr) << "nothing is said of its looks";
  Attribute normals;
  normals.kind = AttributeKind::kNormal;
  normals.domain = AttributeDomain::kCorner;
  normals.components = 3;
  normals.values = {0, 0, 1, 0, -1, 0};
  normals.corners = {0, 0, 0, 1, 1, 1};
  properties.attributes = {normals};
  const std::shared_ptr<const Surface> hard = make_surface(mesh, properties, {});
  ASSERT_NE(hard, nullptr);
  ASSERT_EQ(hard->view.vertex_count(), 6u);
  SurfaceFrame frame;
  frame.set(*hard, positions);
  for (std::size_t i = 0; i < 6; ++i) {
    const float length = std::abs(frame.normals()[3 * i + 1]) + std::abs(frame.normals()[3 * i + 2]);
    EXPECT_FLOAT_EQ(length, 1) << i << ": it is that of one face";
  }
}

}  // namespace
}  // namespace tvg::player
