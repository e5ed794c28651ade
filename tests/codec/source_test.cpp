#include "codec_toolbox.hpp"

#include <gtest/gtest.h>
#include <memory>

namespace tvg::test {
namespace {

/// Five frames of a triangle, frame f at height f, with metadata and a joint that rises with it.
struct Rising {
  Rising() {
    tracks.skeleton.joint_names = {"root"};
    tracks.skeleton.parents = {-1};
    for (int f = 0; f < 5; ++f) {
      const float height = static_cast<float>(f);
      sequence.frames.push_back({0, 0, height, 1, 0, height, 0, 1, height});
      tracks.frames.push_back({0, 0, height});
    }
  }

  std::unique_ptr<FrameSource> source() const { return std::make_unique<SequenceSource>(sequence, &tracks); }

  Sequence sequence{{3, {{0, 1, 2}}}, {}, {{"fps", "25"}}};
  JointTracks tracks;
};

TEST(FrameSource, PassesOverFramesByReadingThemWhereThereIsNoShorterWay) {
  const Rising rising;
  const std::unique_ptr<FrameSource> source = rising.source();
  ASSERT_TRUE(source->skip_frames(3).ok());
  FramePositions frame(9);
  ASSERT_TRUE(*source->read_frame(frame));
  EXPECT_EQ(frame, rising.sequence.frames[3]);
  EXPECT_TRUE(source->skip_frames(1).ok());
  const Status beyond = source->skip_frames(1);
  ASSERT_FALSE(beyond.ok());
  EXPECT_EQ(beyond.error().code, ErrorCode::kInvalidArgument);
}

TEST(SourceDecorator, IsTheOtherSourceButForWhatIsOverridden) {
  class Upwards final : public SourceDecorator {
   public:
    using SourceDecorator::SourceDecorator;
    Result<bool> read_frame(std::span<float> positions) override {
      Result<bool> read = SourceDecorator::read_frame(positions);
      for (float& x : positions) x += 1;
      return read;
    }
  };
  const Rising rising;
  Upwards source(rising.source());
  EXPECT_EQ(source.mesh(), rising.sequence.mesh);
  EXPECT_EQ(source.metadata(), rising.sequence.metadata);
  EXPECT_EQ(source.skeleton().joint_names, rising.tracks.skeleton.joint_names);
  EXPECT_EQ(source.frame_count(), 5u);
  ASSERT_TRUE(source.skip_frames(4).ok());
  FramePositions frame(9);
  ASSERT_TRUE(*source.read_frame(frame));
  EXPECT_EQ(frame[2], 5);
  EXPECT_EQ(source.joint_positions()[2], 4);
  EXPECT_FALSE(*source.read_frame(frame));
  ASSERT_TRUE(source.rewind());
  ASSERT_TRUE(*source.read_frame(frame));
  EXPECT_EQ(frame[2], 1);
}

}  // namespace
}  // namespace tvg::test
