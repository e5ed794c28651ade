#include "tests/importers/scene_fixture.hpp"

#include <gmock/gmock.h>

// How keys of a glTF clip are joined.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

using GltfClip = Scenes;

/// x of vertex 0 in all frames.
std::vector<float> way(const std::vector<FramePositions>& frames) {
  std::vector<float> xs;
  for (const FramePositions& frame : frames) xs.push_back(frame[0]);
  return xs;
}

void expect_way(const std::vector<FramePositions>& frames, const std::vector<float>& expected) {
  EXPECT_THAT(way(frames), ::testing::Pointwise(::testing::FloatNear(1e-5F), expected));
}

TEST_F(GltfClip, StepsHoldEachKeyUntilTheNext) {
  GltfBuilder gltf = one_triangle();
  gltf.animate(0, 0, "translation", {0, 0.5F, 1}, gltf.add<float>("VEC3", {0, 0, 0, 2, 0, 0, 5, 0, 0}),
               "STEP");
  const OpenedSource opened = open(gltf, {"", {}, "4"});
  expect_way(read_all(*opened.source).frames, {0, 0, 2, 2, 5});
  EXPECT_THAT(opened.notes, Not(Contains(HasSubstr("keys"))));
}

TEST_F(GltfClip, AStepFallsOnItsFrameWhateverRoundingDoesToItsTime) {
  GltfBuilder gltf = one_triangle();
  std::vector<float> times, values;
  for (int frame = 0; frame <= 90; ++frame) {
    times.push_back(static_cast<float>(frame) / 30);
    values.insert(values.end(), {static_cast<float>(frame), 0, 0});
  }
  gltf.animate(0, 0, "translation", times, gltf.add<float>("VEC3", values), "STEP");
  const std::vector<FramePositions> read = frames(gltf, "30");
  ASSERT_EQ(read.size(), 91U);
  for (std::size_t frame = 0; frame < read.size(); ++frame)
    EXPECT_EQ(read[frame][0], static_cast<float>(frame));
}

TEST_F(GltfClip, StepsOfRotationsAndWeightsHold) {
  GltfBuilder turn = one_triangle();
  turn.animate(0, 0, "rotation", {0, 1}, turn.add<float>("VEC4", {0, 0, 0, 1, 0, 0, 1, 0}), "STEP");
  const std::vector<FramePositions> turned = frames(turn, "2");
  expect_vertex(turned.at(1), 1, 1, 0, 0);
  expect_vertex(turned.at(2), 1, -1, 0, 0);
  GltfBuilder morph = morphing_triangle();
  morph.animate(0, 0, "weights", {0, 1}, morph.add<float>("SCALAR", {0, 0, 1, 0}), "STEP");
  const std::vector<FramePositions> morphed = frames(morph, "2");
  expect_vertex(morphed.at(1), 2, 0, 1, 1);
  expect_vertex(morphed.at(2), 2, 0, 1, 9);
}

TEST_F(GltfClip, SplinesScaleTangentsByTheTimeBetweenKeys) {
  GltfBuilder gltf = one_triangle();
  // From 0 to 2 in two seconds, leaving at 3 per second and arriving at rest.
  gltf.animate(0, 0, "translation", {0, 2},
               gltf.add<float>("VEC3", {9, 9, 9, 0, 0, 0, 3, 0, 0, 0, 0, 0, 2, 0, 0, 9, 9, 9}),
               "CUBICSPLINE");
  const auto at = [](float t) {
    return (t * t * t - 2 * t * t + t) * 2 * 3 + (3 * t * t - 2 * t * t * t) * 2;
  };
  expect_way(frames(gltf, "2"), {0, at(0.25F), at(0.5F), at(0.75F), 2});
}

TEST_F(GltfClip, SplinesOfRotationsHaveUnitLength) {
  GltfBuilder gltf = one_triangle();
  gltf.animate(0, 0, "rotation", {0, 1},
               gltf.add<float>("VEC4", {0, 0, 0, 0, 0, 0, 0,     1,     0, 0, 0, 0,  //
                                        0, 0, 0, 0, 0, 0, kHalf, kHalf, 0, 0, 0, 0}),
               "CUBICSPLINE");
  const FramePositions middle = frames(gltf, "2").at(1);
  // Half way between both in a straight line, and out to the sphere again: 45 degrees.
  expect_vertex(middle, 1, kHalf, kHalf, 0);
}

TEST_F(GltfClip, SplinesOfMorphWeightsAreRead) {
  GltfBuilder gltf = morphing_triangle();
  gltf.animate(0, 0, "weights", {0, 1}, gltf.add<float>("SCALAR", {0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0}),
               "CUBICSPLINE");
  const std::vector<FramePositions> read = frames(gltf, "4");
  expect_vertex(read.at(0), 1, 3, 0, 1);
  const float t = 0.25F;
  const float rise = 3 * t * t - 2 * t * t * t;
  expect_vertex(read.at(1), 2, 0, 1, 1 + 8 * rise);
  expect_vertex(read.at(1), 1, 1 + 2 * (1 - rise), 0, 1);
  expect_vertex(read.at(4), 2, 0, 1, 9);
}

TEST_F(GltfClip, RotationsTakeTheShortestArc) {
  GltfBuilder gltf = one_triangle();
  // The same as 90 degrees about z, with the other sign.
  gltf.animate(0, 0, "rotation", {0, 1}, "VEC4", {0, 0, 0, 1, 0, 0, -kHalf, -kHalf});
  expect_vertex(frames(gltf, "2").at(1), 1, kHalf, kHalf, 0);
}

TEST_F(GltfClip, BeginsWithItsFirstKey) {
  GltfBuilder gltf = one_triangle();
  gltf.animate(0, 0, "translation", {2, 3}, "VEC3", {1, 0, 0, 3, 0, 0});
  gltf.animate(0, 0, "scale", {2.5F, 4}, "VEC3", {1, 1, 1, 4, 4, 4});
  const std::vector<FramePositions> read = frames(gltf, "1");
  expect_way(read, {1, 3, 3});
  expect_vertex(read.at(2), 1, 7, 0, 0);
}

TEST_F(GltfClip, LeavesTheRestOfANodeAsItIs) {
  GltfBuilder gltf = one_triangle();
  gltf.json["nodes"][0].update(
      {{"translation", {0, 5, 0}}, {"rotation", {0, 0, kHalf, kHalf}}, {"scale", {2, 2, 2}}});
  gltf.animate(0, 0, "scale", {0, 1}, "VEC3", {2, 2, 2, 3, 3, 3});
  expect_vertex(frames(gltf, "1").at(1), 1, 0, 8, 0);
  GltfBuilder matrix = one_triangle();
  matrix.json["nodes"][0]["matrix"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 5, 0, 1};
  matrix.animate(0, 0, "translation", {0, 1}, "VEC3", {0, 5, 0, 1, 5, 0});
  const FramePositions last = frames(matrix, "1").at(1);
  expect_vertex(last, 1, 1, 7, 0);
  expect_vertex(last, 2, -1, 5, 0);
}

TEST_F(GltfClip, WithKeysThatMakeNoSenseIsRefused) {
  const auto expect = [this](const std::vector<float>& times, const std::vector<float>& values,
                             const std::string& interpolation, const std::string& part) {
    GltfBuilder gltf = one_triangle();
    gltf.animate(0, 0, "translation", times, gltf.add<float>("VEC3", values), interpolation);
    gltf.json["animations"][0]["name"] = "walk";
    EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr(part));
  };
  expect({0, 1}, {0, 0, 0}, "LINEAR",
         "clip \"walk\", translation of node \"ThingNode\" has 2 keys and 3 numbers");
  expect({0, 1}, {0, 0, 0, 1, 1, 1}, "CUBICSPLINE", "has 2 keys and 6 numbers, where each key has 9");
  expect({0, 1}, {0, 0, 0, 1, 1, 1}, "BEZIER", "clip \"walk\" has the interpolation \"BEZIER\"");
  GltfBuilder nowhere = one_triangle();
  nowhere.animate(0, 3, "translation", {0, 1}, "VEC3", {0, 0, 0, 1, 1, 1});
  EXPECT_THAT(refusal(nowhere, {}).what(), HasSubstr("moves node 3 of 1"));
}

}  // namespace
}  // namespace tvg::cli
