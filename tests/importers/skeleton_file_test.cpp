#include "encoder/importers/skeleton_file.hpp"

#include "corpus/corpus.hpp"
#include "corpus/write_cache.hpp"
#include "encoder/importers/import_error.hpp"
#include "io_toolbox.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

class SkeletonFile : public ::testing::Test {
 protected:
  /// What reading this text complains about; empty where it does not.
  std::string complaint(const std::string& text) const {
    folder_.write("s.json", text);
    try {
      read_skeleton_file(folder_.path("s.json"));
      return "";
    } catch (const ImportError& error) {
      EXPECT_THAT(error.what(), HasSubstr("s.json"));
      EXPECT_EQ(error.status(), ExitStatus::kInvalidInput) << text;
      return error.what();
    }
  }

  TemporaryFolder folder_;
};

TEST_F(SkeletonFile, GivesBackWhatTheCorpusWrote) {
  const JointTracks hand = corpus::make_hand({400, 7}).joints;
  corpus::write_skeleton(folder_.path("s.json"), hand);
  const JointTracks read = read_skeleton_file(folder_.path("s.json"));
  EXPECT_EQ(read.skeleton.joint_names, hand.skeleton.joint_names);
  EXPECT_EQ(read.skeleton.parents, hand.skeleton.parents);
  EXPECT_EQ(read.skeleton.heaviest_joint, hand.skeleton.heaviest_joint);
  EXPECT_EQ(read.frames, hand.frames);
}

TEST_F(SkeletonFile, RefusesWhatIsNotOneAndSaysWhere) {
  EXPECT_THAT(complaint("{"), HasSubstr("JSON"));
  EXPECT_THAT(complaint("3"), HasSubstr("joints"));
  EXPECT_THAT(complaint("{\"joints\": []}"), HasSubstr("\"joints\""));
  const std::string joints = "{\"joints\": [{\"name\": \"a\", \"parent\": null}], ";
  EXPECT_EQ(complaint(joints + "\"frames\": [[[1, 2.5, -3e2]]]}"), "");
  EXPECT_THAT(complaint(joints + "\"frames\": []}"), HasSubstr("\"frames\""));
  EXPECT_THAT(complaint(joints + "\"frames\": [[[1, 2, 3]], []]}"), HasSubstr("frame 1"));
  EXPECT_THAT(complaint(joints + "\"frames\": [[[1, 2]]]}"), HasSubstr("frame 0, joint 0"));
  EXPECT_THAT(complaint(joints + "\"frames\": [[[1, 2, \"x\"]]]}"), HasSubstr("frame 0, joint 0"));
  EXPECT_THAT(complaint(joints + "\"frames\": [[[1, 2, 1e300]]]}"), HasSubstr("finite"));
  EXPECT_THAT(complaint(joints + "\"frames\": [[[1, 2, 1e999]]]}"), HasSubstr("JSON"));
  EXPECT_THAT(complaint(joints + "\"frames\": [[[1, 2, 3]]], \"heaviest_joint\": [0, 1]}"),
              HasSubstr("vertex 1"));
  EXPECT_THAT(complaint("{\"joints\": [{\"name\": \"a\", \"parent\": 0}], \"frames\": [[[1, 2, 3]]]}"),
              HasSubstr("parent of joint 0"));
  EXPECT_THAT(complaint("{\"joints\": [{\"name\": \"a\", \"parent\": -1}], \"frames\": [[[1, 2, 3]]]}"),
              HasSubstr("parent of joint 0"));
  EXPECT_THAT(complaint("{\"joints\": [{\"name\": 1, \"parent\": null}], \"frames\": [[[1, 2, 3]]]}"),
              HasSubstr("joint 0"));
  EXPECT_THROW(read_skeleton_file(folder_.path("absent.json")), ImportError);
}

TEST_F(SkeletonFile, JointsGoWithTheFramesAlsoOfARangeAndAfterARewind) {
  const corpus::SkinnedSequence hand = corpus::make_hand({400, 7});
  Sequence part = hand.sequence;
  part.frames.erase(part.frames.begin(), part.frames.begin() + 3);
  const auto source = with_joints(std::make_unique<SequenceSource>(part), hand.joints, "s.json", 3);
  FramePositions frame(3 * std::size_t{part.mesh.vertex_count});
  EXPECT_EQ(source->skeleton().joint_names.size(), 21U);
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t f = 3; f < 7; ++f) {
      ASSERT_TRUE(*source->read_frame(frame));
      EXPECT_TRUE(std::ranges::equal(source->joint_positions(), hand.joints.frames[f])) << f;
    }
    EXPECT_FALSE(*source->read_frame(frame));
    ASSERT_TRUE(source->rewind());
  }
}

TEST_F(SkeletonFile, RefusesASourceItDoesNotFit) {
  const corpus::SkinnedSequence hand = corpus::make_hand({400, 7});
  const auto join = [&](JointTracks tracks, std::uint64_t first_frame) {
    with_joints(std::make_unique<SequenceSource>(hand.sequence), std::move(tracks), "s.json", first_frame);
  };
  EXPECT_NO_THROW(join(hand.joints, 0));
  EXPECT_THROW(join(hand.joints, 1), ImportError) << "too few frames";
  JointTracks other = hand.joints;
  other.skeleton.heaviest_joint.pop_back();
  EXPECT_THROW(join(other, 0), ImportError) << "another number of vertices";
}

}  // namespace
}  // namespace tvg::cli::testing
