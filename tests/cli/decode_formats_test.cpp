#include "tests/cli/tool_test_fixture.hpp"
#include "tests/exporters/whole_mesh.hpp"

#include <tvg/encoder.hpp>

// What a stream has beside positions, through `tvg decode` to files.
namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class DecodeFormats : public ToolTest {
 protected:
  static constexpr int kWholeFrames = 6;

  /// Writes `whole.tvg`: six frames in three GOPs, with materials, an image and a time for each frame.
  DecodeFormats() {
    ByteString times(false);
    for (int i = 0; i < kWholeFrames; ++i) times.add(0.5 * i * i);
    EncodeOptions options;
    options.gop_frames = 2;
    options.metadata = {{"fps", "25"}, {"name", "squares"}};
    options.data = {two_materials(), named_data("image/wood.png", kPng), named_data("times", times.bytes())};
    std::string bytes;
    Encoder encoder(options, [&bytes](std::span<const std::uint8_t> piece) {
      bytes.append(piece.begin(), piece.end());
      return Status();
    });
    whole_.add_colours();
    EXPECT_TRUE(encoder.set_mesh(whole_.mesh, {}, whole_.properties).ok());
    for (int i = 0; i < kWholeFrames; ++i) EXPECT_TRUE(encoder.add_frame(whole_.frame(i)).ok());
    EXPECT_TRUE(encoder.finish());
    folder_.write("whole.tvg", bytes);
  }

  WholeMesh whole_;
};

TEST_F(DecodeFormats, PropertiesAndDataReachTheFilesOnOneThreadAndOnSeveral) {
  for (const std::string threads : {"1", "3"}) {
    const Outcome decoded = good("tvg decode whole.tvg -o back_%d.obj --threads " + threads);
    EXPECT_THAT(decoded.err, HasSubstr("back_0.obj to back_5.obj, with wood.png, back.mtl: 6 frames"));
    EXPECT_THAT(decoded.err, HasSubstr("OBJ has no place for the frames' uneven times"));
    EXPECT_EQ(folder_.read("wood.png"), kPng);
    EXPECT_THAT(folder_.read("back.mtl"), HasSubstr("newmtl red\nKd 1 0 0\n"));
    for (int i = 0; i < kWholeFrames; ++i) {
      const std::string obj = folder_.read("back_" + std::to_string(i) + ".obj");
      EXPECT_THAT(obj, StartsWith("# TVG\nmtllib back.mtl\nv "));
      EXPECT_THAT(obj, HasSubstr("o left\ng front\nusemtl red\nf "));
      EXPECT_THAT(obj, HasSubstr("o right\ng\nusemtl blue\nf "));
    }
  }
}

TEST_F(DecodeFormats, APartOfTheFramesHasItsOwnTimes) {
  const Outcome decoded = good("tvg decode whole.tvg --frames 2-4 -o back.mdd");
  EXPECT_THAT(decoded.err, HasSubstr("attributes and parts are in back.obj"));
  ByteString header(true);
  header.add(3).add(6);
  for (const float time : {2.0F, 4.5F, 8.0F}) header.add(time);
  EXPECT_THAT(folder_.read("back.mdd"), StartsWith(header.bytes()));
}

TEST_F(DecodeFormats, ASceneOfGltfIsTheSameAnimation) {
  good(
      "tvg encode hand.obj hand.pc2 -o hand.tvg --fps 25 && tvg decode hand.tvg -o hand.glb && tvg decode "
      "hand.tvg -o text.gltf --gltf-positions quantized "
      "--gltf-keys step");
  for (const std::string scene : {"hand.glb", "text.gltf"}) {
    EXPECT_THAT(good("tvg compare hand.tvg " + scene + " --fps 25").out, StartsWith("12 frames of"));
  }
  expect_failure("tvg decode hand.tvg -o hand.glb --gltf-keys cubic", 1, "--gltf-keys");
  expect_failure("tvg decode hand.tvg -o hand.fbx", 1, "suffix that cannot be written");
}

TEST_F(DecodeFormats, WhatAFormatCannotHoldIsTold) {
  EXPECT_THAT(good("tvg decode whole.tvg -o back_%d.stl").err, HasSubstr("STL has no place for"));
  EXPECT_THAT(good("tvg decode whole.tvg -o back_%d.ply").err,
              HasSubstr("PLY has no place for the frames' uneven times and objects, groups and materials"));
  EXPECT_THAT(good("tvg decode whole.tvg -o back.glb").err, Not(HasSubstr("has no place")));
  EXPECT_THAT(good("tvg decode whole.tvg -o back.npy").err,
              HasSubstr("NPY has no place for the frames' uneven"));
  EXPECT_EQ(good("tvg decode whole.tvg -o back.glb --quiet").err, "");
}

}  // namespace
}  // namespace tvg::cli::testing
