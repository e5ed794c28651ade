#include "encoder/importers/open_source.hpp"
#include "encoder/importers/scene_summary.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pointwise;

/// A hip that moves by 1 along x each frame, a knee that turns by 90 degrees about z each frame, a foot.
std::string bvh(int frames) {
  std::string text =
      "HIERARCHY\nROOT Hip\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition Zrotation "
      "Xrotation "
      "Yrotation\n  JOINT Knee\n  {\n    OFFSET 0 -2 0\n    CHANNELS 3 Zrotation Xrotation Yrotation\n"
      "    End Site\n    {\n      OFFSET 0 -1 0\n    }\n  }\n}\nMOTION\n";
  text += "Frames: " + std::to_string(frames) + "\nFrame Time: 0.1\n";
  for (int frame = 0; frame < frames; ++frame) {
    text.append(std::to_string(frame))
        .append(" 5 0 0 0 0 ")
        .append(std::to_string(90 * frame))
        .append(" 0 0\n");
  }
  return text;
}

class SkeletonOfACache : public ::testing::Test {
 protected:
  SourceSpec spec(int cache_frames, int bvh_frames) {
    SourceSpec spec{{folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n"),
                     folder_.write("a.pc2", pc2_bytes(4, cache_frames, cache_frames))}};
    spec.skeleton = folder_.write("a.bvh", bvh(bvh_frames));
    return spec;
  }
  std::vector<std::vector<float>> joints(const SourceSpec& spec) {
    const OpenedSource opened = open_source(spec);
    notes_ = opened.notes;
    names_ = opened.source->skeleton().joint_names;
    parents_ = opened.source->skeleton().parents;
    std::vector<std::vector<float>> result;
    FramePositions positions(3 * std::size_t{opened.source->mesh().vertex_count});
    while (*opened.source->read_frame(positions)) {
      const auto joints = opened.source->joint_positions();
      result.emplace_back(joints.begin(), joints.end());
    }
    return result;
  }
  TemporaryFolder folder_;
  std::vector<std::string> notes_, names_;
  std::vector<std::int32_t> parents_;
};

TEST_F(SkeletonOfACache, FollowsTheFramesOneToOneWhereThereAreAsMany) {
  const auto frames = joints(spec(3, 3));
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_THAT(names_, ElementsAre("Hip", "Knee", "EndSite_Knee"));
  EXPECT_THAT(parents_, ElementsAre(-1, 0, 1));
  const auto near = [](const std::vector<float>& expected) { return Pointwise(FloatNear(1e-5F), expected); };
  EXPECT_THAT(frames[0], near({0, 5, 0, 0, 3, 0, 0, 2, 0}));
  EXPECT_THAT(frames[1], near({1, 5, 0, 1, 3, 0, 2, 3, 0}));
  EXPECT_THAT(frames[2], near({2, 5, 0, 2, 3, 0, 2, 4, 0}));
  EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(SkeletonOfACache, KeepsItsPlaceWhenFramesAreLeftOut) {
  SourceSpec some = spec(3, 3);
  some.frames = FrameRange{1, 2};
  const auto frames = joints(some);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_FLOAT_EQ(frames[0][0], 1);
}

TEST_F(SkeletonOfACache, FollowsByTimeWhereTheCountsDiffer) {
  SourceSpec other = spec(6, 3);
  EXPECT_THAT(thrown_by([&] { open_source(other); }).what(), HasSubstr("--fps has to say the input's rate"));
  other.scene.fps = "20";
  const auto frames = joints(other);
  ASSERT_EQ(frames.size(), 6U);
  for (std::size_t frame = 0; frame < 6; ++frame) {
    EXPECT_NEAR(frames[frame][0], std::min(0.5 * static_cast<double>(frame), 2.0), 1e-5) << frame;
  }
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("after 0.2 of 0.25 s they hold still")));
}

TEST_F(SkeletonOfACache, RefusesWhatIsNoMotion) {
  SourceSpec bad = spec(3, 3);
  const auto expect = [&](const std::string& file, ExitStatus status, const std::string& part) {
    bad.skeleton = file;
    const ToolError error = thrown_by([&] { open_source(bad); });
    EXPECT_EQ(error.status(), status);
    EXPECT_THAT(error.what(), HasSubstr(part));
  };
  expect(folder_.path("a.obj"), ExitStatus::kUsage, "only BVH files");
  expect(folder_.path("none.bvh"), ExitStatus::kIo, "No such file");
  expect(folder_.write("b.bvh", bvh(3).substr(0, 200)), ExitStatus::kInvalidInput, "b.bvh: ");
}

TEST_F(SkeletonOfACache, IsListedWithoutAMesh) {
  const SceneSummary summary = summarize_scene(folder_.write("a.bvh", bvh(3)), 10);
  EXPECT_THAT(summary.skeleton.joint_names, ElementsAre("Hip", "Knee", "EndSite_Knee"));
  ASSERT_EQ(summary.clips.size(), 1U);
  EXPECT_EQ(summary.clips[0].frames, 3U);
}

}  // namespace
}  // namespace tvg::cli
