#include "tests/codec/properties_toolbox.hpp"
#include "tool_test_fixture.hpp"

#include <cmath>
#include <fmt/format.h>

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two streams of the hand whose mesh has more than connectivity: as it should be, and with differences.
class PropertiesTest : public ToolTest {
 protected:
  PropertiesTest() {
    const Mesh& mesh = hand_.mesh;
    Attribute uv;
    uv.name = "UVMap";
    uv.kind = AttributeKind::kTexcoord;
    uv.domain = AttributeDomain::kCorner;
    uv.components = 2;
    uv.bits = 12;
    for (std::uint32_t corner = 0; corner < 3 * mesh.faces.size(); ++corner) {
      const std::uint32_t vertex = mesh.faces[corner / 3][corner % 3];
      const float u = static_cast<float>(vertex) / static_cast<float>(mesh.vertex_count);
      uv.values.insert(uv.values.end(), {corner / 3 < 9 ? 1 - u : u, 0.5f});
      uv.corners.push_back(corner);
    }
    Attribute normal;
    normal.kind = AttributeKind::kNormal;
    normal.components = 3;
    normal.bits = 10;
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v)
      normal.values.insert(normal.values.end(), {0.6f, 0, v % 2 == 0 ? 0.8f : -0.8f});
    properties_.attributes = {uv, normal};
    properties_.parts = {{"hand", "palm", "skin"}, {"hand", "nails", "varnish"}};
    for (std::size_t face = 0; face < mesh.faces.size(); ++face)
      properties_.face_parts.push_back(face % 5 == 0 ? 1 : 0);
  }

  void write_stream(const std::string& name) {
    test::PropertySource source(hand_, properties_);
    std::string stream;
    const Result<EncodeReport> made = encode(source, {}, [&stream](std::span<const std::uint8_t> bytes) {
      stream.append(bytes.begin(), bytes.end());
      return Status();
    });
    ASSERT_TRUE(made) << made.error().message;
    folder_.write(name, stream);
  }

  MeshProperties properties_;
};

TEST_F(PropertiesTest, WhatChangesFromFileToFileComesBackWithItsFrame) {
  const auto file = [](int frame) {
    std::string text;
    for (int v = 0; v < 4; ++v)
      text += fmt::format("v {} {} {} {} 0.5 1\n", v % 2, v / 2, 0.125 * frame * v, 0.25 * ((v + frame) % 4));
    for (int v = 0; v < 5; ++v) text += fmt::format("vt {} {}\n", 0.25 * v, 0.125 * frame);
    for (int v = 0; v < 4; ++v) text += v % 2 == frame % 2 ? "vn 0.6 0 0.8\n" : "vn 0 0.8 0.6\n";
    return text + "f 1/1/1 2/2/2 4/4/4\nf 1/5/1 4/4/4 3/3/3\n";
  };
  for (int frame = 0; frame < 3; ++frame) folder_.write(fmt::format("m_{}.obj", frame), file(frame));
  const Outcome made =
      good("tvg encode m_%d.obj -o m.tvg --uv-bits exact --normal-bits exact --colour-bits exact");
  EXPECT_THAT(made.err, HasSubstr("change from frame to frame"));
  for (const char* const command :
       {"tvg compare m_%d.obj m.tvg --json", "tvg compare n_%d.obj m.tvg --json"}) {
    const nlohmann::json compared = json(command)["attributes"];
    ASSERT_EQ(compared.size(), 3u);
    for (const nlohmann::json& attribute : compared) {
      EXPECT_EQ(attribute["animated"], true) << attribute;
      EXPECT_EQ(attribute["max_difference"], 0) << attribute;
    }
    good("tvg decode m.tvg -o n_%d.obj --threads 2");
  }
  const nlohmann::json info = json("tvg info --bits m.tvg --json");
  for (const nlohmann::json& attribute : info["attributes"]) {
    EXPECT_EQ(attribute["animated"], true);
    EXPECT_GT(attribute["frame_bytes"], 0);
  }
  EXPECT_GT(info["bytes_by_purpose"]["animated_attributes"], 0);
  EXPECT_THAT(good("tvg decode m.tvg -o m.glb").err, HasSubstr("they stay as they are first"));
}

TEST_F(PropertiesTest, InfoListsAttributesAndParts) {
  write_stream("rich.tvg");
  const nlohmann::json info = json("tvg info rich.tvg --json");
  ASSERT_EQ(info["attributes"].size(), 2u);
  const nlohmann::json& uv = info["attributes"][0];
  EXPECT_EQ(uv["name"], "UVMap");
  EXPECT_EQ(uv["kind"], "texcoord");
  EXPECT_EQ(uv["domain"], "corner");
  EXPECT_EQ(uv["components"], 2);
  EXPECT_EQ(uv["bits"], 12);
  EXPECT_GE(uv["values"], hand_.mesh.vertex_count);
  EXPECT_EQ(info["attributes"][1]["values"], hand_.mesh.vertex_count);
  ASSERT_EQ(info["parts"].size(), 2u);
  const std::size_t faces = hand_.mesh.faces.size();
  EXPECT_EQ(info["parts"][1]["faces"], (faces + 4) / 5);
  EXPECT_EQ(info["parts"][0]["material"], "skin");
  EXPECT_EQ(info["polygons"], 0);
  EXPECT_GT(info["bytes_by_purpose"]["attributes"], 0);
  EXPECT_GT(info["bytes_by_purpose"]["parts"], 0);
  const std::string text = good("tvg info rich.tvg").out;
  EXPECT_THAT(text, HasSubstr("UVMap"));
  EXPECT_THAT(text, HasSubstr("'hand', 'nails', 'varnish'"));
  good("cat rich.tvg | tvg info -");
}

TEST_F(PropertiesTest, InfoOfABareMeshSaysNothingOfThem) {
  good("tvg encode hand.obj hand.pc2 -o bare.tvg");
  const nlohmann::json info = json("tvg info bare.tvg --json");
  EXPECT_TRUE(info["attributes"].empty());
  EXPECT_EQ(info["bytes_by_purpose"]["attributes"], 0);
  EXPECT_THAT(good("tvg info bare.tvg").out, Not(HasSubstr("domain")));
}

TEST_F(PropertiesTest, CompareMeasuresAttributesAndParts) {
  write_stream("rich.tvg");
  Attribute& uv = properties_.attributes[0];
  uv.values[0] += 0.25f;
  Attribute& normal = properties_.attributes[1];
  std::copy_n(std::array<float, 3>{-0.6f, 0, -0.8f}.begin(), 3, normal.values.begin());
  properties_.face_parts[0] = 0;
  write_stream("other.tvg");
  const nlohmann::json same = json("tvg compare rich.tvg rich.tvg --json");
  ASSERT_EQ(same["attributes"].size(), 2u);
  EXPECT_EQ(same["attributes"][0]["max_difference"], 0);
  EXPECT_EQ(same["attributes"][0]["values"], 3 * hand_.mesh.faces.size());
  EXPECT_EQ(same["parts"]["equal"], true);
  EXPECT_EQ(same["unmatched_faces"], 0);
  const nlohmann::json other = json("tvg compare rich.tvg other.tvg --json");
  EXPECT_NEAR(other["attributes"][0]["max_difference"], 0.25, 0.001);
  EXPECT_EQ(other["attributes"][1]["unit"], "degrees");
  EXPECT_NEAR(other["attributes"][1]["max_difference"], 180, 0.5);
  EXPECT_EQ(other["parts"]["different"], 1);
  EXPECT_EQ(other["materials"]["different"], 1);
  const std::string text = good("tvg compare rich.tvg other.tvg").out;
  EXPECT_THAT(text, HasSubstr("texcoord 'UVMap'"));
  EXPECT_THAT(text, HasSubstr("in degrees"));
  EXPECT_THAT(text, HasSubstr("DIFFERENT: 1 faces"));
}

TEST_F(PropertiesTest, CompareSaysWhatOneSideLacks) {
  write_stream("rich.tvg");
  good("tvg encode hand.obj hand.pc2 -o bare.tvg");
  const nlohmann::json found = json("tvg compare rich.tvg bare.tvg --json");
  EXPECT_EQ(found["attributes"][0]["side"], "original");
  EXPECT_EQ(found["parts"]["decoded"], 0);
  EXPECT_THAT(good("tvg compare bare.tvg rich.tvg").out, HasSubstr("only in the decoded frames"));
  // Two caches with one mesh have no more than positions to compare.
  EXPECT_TRUE(json("tvg compare hand.pc2 hand.pc2 --mesh hand.obj --json")["attributes"].empty());
}

}  // namespace
}  // namespace tvg::cli::testing
