#include "measure/joint_motion.hpp"
#include "measure_toolbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace tvg {
namespace {

using test::arm;
using test::bent_arm;
using test::Joints;
using testing::Each;
using testing::ElementsAre;

std::vector<double> skel(const Skeleton& skeleton, const Joints& joints, const FramePositions& vertices,
                         const Importance& options = {}) {
  const Mesh mesh{static_cast<std::uint32_t>(vertices.size() / 3), {}};
  const std::vector<FramePositions> frames(joints.size(), vertices);
  const Topology topology(mesh);
  const std::vector<JointMotion> motions =
      judge_joints(joint_angle_sums(skeleton, joints), joints.size() - 1, options.skel.threshold);
  return skeleton_criterion({topology, frames, options, skeleton, joints, motions});
}

TEST(JointAngleSums, AreEquation4WorkedByHandOnAnArm) {
  // The angle at the elbow goes 180, 150, 90, 135: changes of 30, 60 and 45 degrees. The ends have one
  // segment each, and so no angle.
  const std::vector<double> sums =
      joint_angle_sums(arm(), Joints{bent_arm(0), bent_arm(30), bent_arm(90), bent_arm(45)});
  ASSERT_EQ(sums.size(), 3U);
  EXPECT_EQ(sums[0], 0);
  EXPECT_NEAR(sums[1], 30 + 60 + 45, 1e-4);
  EXPECT_EQ(sums[2], 0);
}

TEST(JointAngleSums, TakeEveryPairAlsoOfTwoChildren) {
  // Three children along x, y and -x; the second turns to z and then back to 45 degrees between y and x.
  // Parent pairs: none (root). Pairs of children: 0-1: 90, 90, 45; 1-2: 90, 90, 135; 0-2: always 180.
  const Skeleton fork{{"root", "a", "b", "c"}, {-1, 0, 0, 0}, {}};
  const float diagonal = std::sqrt(0.5F);
  const Joints joints = {{0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0},
                         {0, 0, 0, 1, 0, 0, 0, 0, 1, -1, 0, 0},
                         {0, 0, 0, 1, 0, 0, diagonal, diagonal, 0, -1, 0, 0}};
  const std::vector<double> sums = joint_angle_sums(fork, joints);
  EXPECT_NEAR(sums[0], 45 + 45, 1e-4);
  EXPECT_THAT(std::vector<double>(sums.begin() + 1, sums.end()), Each(0));
}

TEST(JointAngleSums, DoNotSeeMotionOfTheWholeNorSegmentsThatStretch) {
  Joints joints;
  for (int f = 0; f < 5; ++f) {
    std::vector<float> frame = bent_arm(60);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      frame[i] = frame[i] * static_cast<float>(1 << f) + static_cast<float>(f);
    }
    joints.push_back(frame);
  }
  for (const double sum : joint_angle_sums(arm(), joints)) EXPECT_NEAR(sum, 0, 1e-3);
}

TEST(JointAngleSums, ASegmentWithoutLengthAddsNothing) {
  std::vector<float> collapsed = bent_arm(30);
  for (std::size_t k = 0; k < 3; ++k) collapsed[6 + k] = collapsed[3 + k];
  // Only the last step, 90 to 45 degrees, has both angles.
  const std::vector<double> sums =
      joint_angle_sums(arm(), Joints{bent_arm(0), collapsed, bent_arm(90), bent_arm(45)});
  EXPECT_NEAR(sums[1], 45, 1e-4);
}

TEST(JudgeJoints, AThresholdIsPerFrameAndHasToBePassed) {
  const auto verdict = [](double sum, std::size_t steps, double threshold) {
    return judge_joints({sum}, steps, threshold)[0].dynamic;
  };
  EXPECT_FALSE(verdict(20, 10, 2));
  EXPECT_TRUE(verdict(20.001, 10, 2));
  EXPECT_FALSE(verdict(20.001, 20, 2));
  EXPECT_FALSE(verdict(0, 10, 0));
  EXPECT_TRUE(verdict(1e-9, 10, 0));
}

TEST(JudgeJoints, WithoutAThresholdAQuarterOfTheStrongestCounts) {
  const std::vector<JointMotion> motions = judge_joints({100, 25, 25.1, 0}, 10, std::nullopt);
  EXPECT_TRUE(motions[0].dynamic);
  EXPECT_FALSE(motions[1].dynamic);
  EXPECT_TRUE(motions[2].dynamic);
  EXPECT_FALSE(motions[3].dynamic);
  EXPECT_EQ(motions[2].angle_sum, 25.1);
}

TEST(JudgeJoints, APoseThatIsHeldHasNoDynamicJointsWhateverItsNoise) {
  // Jitter of a thousandth of the segments' length: about 0.08 degrees from frame to frame.
  std::mt19937 random(1);
  std::normal_distribution<float> jitter(0, 3e-4F);
  Joints joints(50, bent_arm(40));
  for (std::vector<float>& frame : joints) {
    for (float& x : frame) x += jitter(random);
  }
  const std::vector<double> sums = joint_angle_sums(arm(), joints);
  EXPECT_GT(sums[1], 1) << "the noise must be there";
  for (const JointMotion& motion : judge_joints(sums, 49, std::nullopt)) EXPECT_FALSE(motion.dynamic);
  EXPECT_THAT(judge_joints({}, 3, std::nullopt), testing::IsEmpty());
}

TEST(NearestJoints, AreThoseOfASearchThroughAllWithTiesToTheFirst) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> place(0, 4);  // a small grid, so that many are equally near
  std::vector<float> joints(3 * 60), vertices(3 * 500);
  for (float& x : joints) x = static_cast<float>(place(random));
  for (float& x : vertices) x = static_cast<float>(place(random)) + 0.5F;
  const std::vector<std::uint32_t> nearest = nearest_joints(vertices, joints);
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    std::uint32_t expected = 0;
    double best = 1e9;
    for (std::uint32_t j = 0; j < 60; ++j) {
      double distance = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = double{vertices[3 * v + k]} - joints[3 * j + k];
        distance += d * d;
      }
      if (distance < best) best = distance, expected = j;
    }
    ASSERT_EQ(nearest[v], expected) << v;
  }
}

TEST(Skel, IsEquation6ByNearestJointInTheFirstFrame) {
  // In the last frame the vertex at (2, 0, 0) is nearest to the elbow, but in the first to the hand.
  const Joints joints = {bent_arm(0), bent_arm(90)};
  const FramePositions vertices = {0.1F, 0, 0, 0.9F, 0, 0, 2, 0, 0};
  EXPECT_THAT(skel(arm(), joints, vertices), ElementsAre(0, 1, 0));
  Importance options;
  options.skel.alpha = 0.75;
  EXPECT_THAT(skel(arm(), joints, vertices, options), ElementsAre(0.25, 0.75, 0.25));
  options.skel.threshold = 91;
  EXPECT_THAT(skel(arm(), joints, vertices, options), Each(0.25));
}

TEST(Skel, TakesTheRegionsOfSkinWeightsWhenAsked) {
  Skeleton skinned = arm();
  skinned.heaviest_joint = {1, 0, 2};
  Importance options;
  options.skel.region = JointRegion::kHeaviest;
  EXPECT_THAT(skel(skinned, {bent_arm(0), bent_arm(90)}, FramePositions(9, 0.0F), options),
              ElementsAre(1, 0, 0));
}

TEST(Skel, OneFrameHasNoDynamicJoints) {
  EXPECT_THAT(skel(arm(), {bent_arm(20)}, {0, 0, 0, 1, 0, 0}), Each(0));
}

TEST(Skel, RefusesWhatItCannotUse) {
  Importance importance;
  importance.criteria = {{"curv", 1}, {"skel", 0.5}};
  const Mesh mesh{3, {{0, 1, 2}}};
  const auto message = [&](const Skeleton& skeleton) {
    const Status status = check_importance(importance, mesh, skeleton);
    return status.ok() ? std::string() : status.error().message;
  };
  EXPECT_EQ(message(arm()), "");
  EXPECT_THAT(message({}), testing::HasSubstr("needs a skeleton"));
  EXPECT_THAT(message({{"a", "b"}, {-1}, {}}), testing::HasSubstr("parents"));
  EXPECT_THAT(message({{"a", "b"}, {1, -1}, {}}), testing::HasSubstr("before its parent"));
  EXPECT_THAT(message({{"a"}, {-2}, {}}), testing::HasSubstr("before its parent"));
  importance.skel.region = JointRegion::kHeaviest;
  EXPECT_THAT(message(arm()), testing::HasSubstr("no skin weights"));
  Skeleton skinned = arm();
  skinned.heaviest_joint = {0, 0, 3};
  EXPECT_THAT(message(skinned), testing::HasSubstr("joint 3 of 3"));
  skinned.heaviest_joint = {0, 0};
  EXPECT_THAT(message(skinned), testing::HasSubstr("another number of vertices"));
  skinned.heaviest_joint = {0, 1, 2};
  EXPECT_EQ(message(skinned), "");
  for (const double alpha : {-0.1, 1.1, std::nan("")}) {
    importance.skel.alpha = alpha;
    EXPECT_NE(message(skinned), "") << alpha;
  }
  importance.skel.alpha = 1;
  importance.skel.threshold = -1;
  EXPECT_THAT(message(skinned), testing::HasSubstr("threshold"));
}

}  // namespace
}  // namespace tvg
