#include "encoder/live/live_encoding.hpp"

#include "encoder/live/pacer.hpp"
#include "tests/codec/codec_toolbox.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace tvg::cli {
namespace {

using test::Stream;

/// Frames 0, 1, ... of a triangle that rises; notes how much of the stream there was when each was asked for.
class Camera final : public FrameSource {
 public:
  Camera(std::size_t frames, const Stream& stream) : frames_(frames), stream_(stream) {}

  const Mesh& mesh() const override { return mesh_; }
  std::optional<std::uint64_t> frame_count() const override { return {}; }
  Result<bool> read_frame(std::span<float> positions) override {
    seen.push_back(stream_.size());
    if (next_ == cut_at) return Error{.code = ErrorCode::kTruncated, .message = "the pipe ends"};
    if (next_ == frames_) return false;
    const float height = static_cast<float>(next_++);
    const FramePositions frame = {0, 0, height, 1, 0, height, 0, 1, height};
    std::copy(frame.begin(), frame.end(), positions.begin());
    return true;
  }
  bool rewind() override {
    next_ = 0;
    return true;
  }

  std::vector<std::size_t> seen;
  std::optional<std::size_t> cut_at;

 private:
  std::size_t frames_;
  const Stream& stream_;
  Mesh mesh_{3, {{0, 1, 2}}};
  std::size_t next_ = 0;
};

ByteSink into(Stream& stream) {
  return [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  };
}

EncodeOptions gops_of_two() {
  EncodeOptions options;
  options.gop_frames = 2;
  return options;
}

TEST(LiveEncoding, AGopHasLeftBeforeTheNextFrameIsAskedFor) {
  Stream stream;
  Camera camera(6, stream);
  const Result<LiveReport> report = encode_live(camera, gops_of_two(), {}, into(stream));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->frames, 6u);
  EXPECT_FALSE(report->cut_short);
  ASSERT_EQ(camera.seen.size(), 7u);
  for (std::size_t f = 1; f < 7; ++f) EXPECT_EQ(camera.seen[f] > camera.seen[f - 1], f % 2 == 0) << f;
  EXPECT_EQ(test::decode_stream(stream).frames.size(), 6u);
}

TEST(LiveEncoding, ALoopBeginsAgainUntilNobodyTakesItsBytes) {
  Stream stream;
  Camera camera(3, stream);
  const Result<LiveReport> report =
      encode_live(camera, gops_of_two(), {.loop = true}, [&](std::span<const std::uint8_t> bytes) {
        if (stream.size() > 2000) return Status(Error{.code = ErrorCode::kIo, .message = "nobody listens"});
        return into(stream)(bytes);
      });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message, "nobody listens");
  const test::DecodedStream back = test::decode_stream(stream);
  ASSERT_GT(back.frames.size(), 6u);
  for (std::size_t f = 3; f < back.frames.size(); ++f)
    EXPECT_NEAR(back.frames[f].positions[2], static_cast<float>(f % 3), 0.01) << f;
}

TEST(LiveEncoding, OnlyAnOpenEndedInputMayEndInsideAFrame) {
  for (const bool open_ended : {true, false}) {
    Stream stream;
    Camera camera(6, stream);
    camera.cut_at = 3;
    const Result<LiveReport> report =
        encode_live(camera, gops_of_two(), {.open_ended = open_ended}, into(stream));
    ASSERT_EQ(static_cast<bool>(report), open_ended);
    if (!open_ended) {
      EXPECT_EQ(report.error().message, "the pipe ends");
      continue;
    }
    EXPECT_EQ(report->cut_short, "the pipe ends");
    EXPECT_EQ(report->frames, 3u);
    EXPECT_TRUE(test::decode_stream(stream).complete);
  }
}

TEST(Pacer, NoFrameComesBeforeItsTime) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point began = Clock::now();
  Pacer pacer(250.0);
  for (int frame = 0; frame < 6; ++frame) {
    pacer.wait_for_next();
    EXPECT_GE(Clock::now() - began, frame * std::chrono::milliseconds(4));
  }
}

}  // namespace
}  // namespace tvg::cli
