#include "encoder/importers/gltf_uri.hpp"
#include "tests/importers/scene_fixture.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

// The files that glTF is in.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

class GltfFile : public Scenes {
 protected:
  std::string message(const std::string& name, std::string_view bytes) {
    const std::string path = folder_.write(name, bytes);
    return thrown_by([&] { open_file(path); }).what();
  }
};

TEST_F(GltfFile, MayBeBinaryWhateverItsSuffix) {
  GltfBuilder gltf = one_triangle();
  EXPECT_EQ(open_file(folder_.write("a.glb", gltf.binary())).source->mesh().faces.size(), 1U);
  EXPECT_EQ(open_file(folder_.write("a.gltf", gltf.binary())).source->mesh().faces.size(), 1U);
  EXPECT_EQ(open_file(folder_.write("b.glb", gltf.text())).source->mesh().faces.size(), 1U);
  EXPECT_EQ(open_file(folder_.write("c.gltf", "\xef\xbb\xbf" + gltf.text())).source->mesh().faces.size(), 1U);
  EXPECT_EQ(open_file(folder_.write("d.glb", gltf.binary() + "and more")).source->mesh().faces.size(), 1U);
}

TEST_F(GltfFile, IsRefusedWhereverABinaryOneIsCut) {
  GltfBuilder gltf = one_triangle();
  const std::string bytes = gltf.binary();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string path = folder_.write("cut.glb", bytes.substr(0, length));
    const ToolError error = thrown_by([&] { open_file(path); });
    EXPECT_EQ(error.status(), ExitStatus::kInvalidInput);
    EXPECT_THAT(error.what(), HasSubstr("cut.glb"));
  }
}

TEST_F(GltfFile, IsRefusedWhereverItsTextIsCut) {
  GltfBuilder gltf = one_triangle();
  const std::string text = gltf.text();
  for (std::size_t length = 0; length + 1 < text.size(); length += 7) {
    EXPECT_THAT(message("cut.gltf", text.substr(0, length)), HasSubstr("cut.gltf"));
  }
}

TEST_F(GltfFile, KeepsItsBufferBeside) {
  GltfBuilder gltf = one_triangle();
  folder_.write("with space \xc3\xa9.bin", gltf.buffer());
  folder_.write("below/100%.bin", gltf.buffer());
  for (const std::string uri :
       {"with%20space%20%C3%A9.bin", "with space \xc3\xa9.bin", "./below/../with%20space \xc3\xa9.bin",
        "below/100%25.bin", "below/100%.bin"}) {
    const std::string path = folder_.write("a.gltf", gltf.text_beside(uri));
    EXPECT_EQ(open_file(path).source->mesh().faces.size(), 1U) << uri;
  }
}

TEST_F(GltfFile, OpensNothingOutsideOfItsFolder) {
  GltfBuilder gltf = one_triangle();
  const std::string outside = folder_.write("outside.bin", gltf.buffer());
  for (const std::string uri : {"../outside.bin", "x/../../outside.bin", "%2e%2e/outside.bin", "..", ""}) {
    EXPECT_THAT(message("in/a.gltf", gltf.text_beside(uri)), HasSubstr("outside of its folder")) << uri;
  }
  EXPECT_THAT(message("in/a.gltf", gltf.text_beside(outside)), HasSubstr("outside of its folder"));
  for (const std::string uri :
       {"http://localhost/a.bin", "https://localhost/a.bin", "file:///etc/hosts", "C:a.bin"}) {
    EXPECT_THAT(message("in/a.gltf", gltf.text_beside(uri)), HasSubstr("nothing is fetched")) << uri;
  }
}

TEST_F(GltfFile, SaysWhichBufferIsMissingOrShort) {
  GltfBuilder gltf = one_triangle();
  EXPECT_THAT(message("a.gltf", gltf.text_beside("none.bin")),
              HasSubstr("its buffer \"none.bin\" is missing"));
  folder_.write("short.bin", gltf.buffer().substr(1));
  EXPECT_THAT(message("a.gltf", gltf.text_beside("short.bin")),
              HasSubstr("buffer 0 promises 42 bytes and has 41"));
  ASSERT_EQ(mkfifo(folder_.path("pipe.bin").c_str(), 0600), 0);
  EXPECT_THAT(message("a.gltf", gltf.text_beside("pipe.bin")), HasSubstr("copy it to a regular file"));
  gltf.json["buffers"] = {{{"byteLength", 42}}};
  EXPECT_THAT(message("a.gltf", gltf.json.dump()), HasSubstr("buffer 0 has no bytes"));
  gltf.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,!!!!";
  EXPECT_THAT(message("a.gltf", gltf.json.dump()), HasSubstr("not well-formed base64"));
}

TEST_F(GltfFile, HasDataUrisOfAllKinds) {
  EXPECT_EQ(decode_data_uri("data:application/octet-stream;base64,AQID"), "\1\2\3");
  EXPECT_EQ(decode_data_uri("data:;base64,AQI="), "\1\2");
  EXPECT_EQ(decode_data_uri("data:;base64,AQ"), "\1");
  EXPECT_EQ(decode_data_uri("data:application/gltf-buffer;base64,-_%2B%2F"), "\xfb\xff\xbf");
  EXPECT_EQ(decode_data_uri("data:,a%20b%2"), "a b%2");
  EXPECT_EQ(decode_data_uri("data:;base64,A"), std::nullopt);
  EXPECT_EQ(decode_data_uri("data:;base64,A*=="), std::nullopt);
  EXPECT_EQ(decode_data_uri("data:nothing"), std::nullopt);
}

TEST_F(GltfFile, IsNestedOnlySoDeep) {
  const std::string deep(100000, '[');
  EXPECT_THAT(message("deep.gltf", deep), HasSubstr("nested more than 64 deep"));
  EXPECT_THAT(message("deep.gltf", R"({"asset":{"version":"2.0"},"extras":)" + deep),
              HasSubstr("nested more than"));
}

TEST_F(GltfFile, OfAnotherVersionIsNamed) {
  GltfBuilder gltf = one_triangle();
  gltf.json["asset"]["version"] = "3.1";
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("it is glTF \"3.1\": 2.0 is read"));
  gltf.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("it is glTF \"2.1\": 2.0 is read"));
  gltf.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.0"}};
  EXPECT_EQ(open(gltf).source->mesh().faces.size(), 1U);
  gltf.json.erase("asset");
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("no \"asset\" with a version"));
}

TEST_F(GltfFile, WithMembersOfAnyWrongTypeIsReadOrRefused) {
  GltfBuilder original = skinned_strip();
  original.text();
  const nlohmann::json flat = original.json.flatten();
  for (const auto& [place, value] : flat.items()) {
    for (const nlohmann::json& other : std::vector<nlohmann::json>{
             nullptr, -1, 1e30, 4294967296, "text", nlohmann::json::array({1}), nlohmann::json::object()}) {
      nlohmann::json broken = original.json;
      broken[nlohmann::json::json_pointer(place)] = other;
      const std::string path = folder_.write("broken.gltf", broken.dump());
      try {
        read_all(*open_file(path).source);
      } catch (const ToolError& error) {
        EXPECT_THAT(error.what(), HasSubstr("broken.gltf")) << place << " " << other;
      }
    }
  }
}

}  // namespace
}  // namespace tvg::cli
