#include "codec_toolbox.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

#include <tvg/encoder.hpp>

namespace tvg {
namespace {

using Stream = std::vector<std::uint8_t>;

ByteSink into(Stream& stream) {
  return [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  };
}

/// A square of two triangles whose third corner rises with the frames.
const Mesh kSquare{4, {{0, 1, 2}, {0, 2, 3}}};
const Mesh kTriangle{3, {{0, 1, 2}}};

FramePositions square_frame(int number) {
  return {0, 0, 0, 1, 0, 0, 1, 1, 0.1F * static_cast<float>(number), 0, 1, 0};
}

struct Decoded {
  std::vector<std::uint32_t> vertices;  ///< of each frame
  bool whole = false;
};

Decoded decode(const Stream& stream) {
  Decoded decoded;
  Decoder decoder;
  decoder.push(stream);
  decoder.finish();
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kFrame:
        decoded.vertices.push_back(decoder.mesh().vertex_count);
        break;
      case Decoder::Event::kEnd:
        decoded.whole = true;
        return decoded;
      case Decoder::Event::kDamage:
      case Decoder::Event::kError:
      case Decoder::Event::kNeedBytes:
        return decoded;
      default:
        break;
    }
  }
}

TEST(PushEncoder, SendsAGopFromTheCallThatCompletesIt) {
  Stream stream;
  EncodeOptions options;
  options.gop_frames = 3;
  Encoder encoder(options, into(stream));
  ASSERT_TRUE(encoder.set_mesh(kSquare).ok());
  const std::size_t start = stream.size();
  ASSERT_TRUE(encoder.add_frame(square_frame(0)).ok());
  ASSERT_TRUE(encoder.add_frame(square_frame(1)).ok());
  EXPECT_EQ(stream.size(), start);
  ASSERT_TRUE(encoder.add_frame(square_frame(2)).ok());
  EXPECT_GT(stream.size(), start);
}

TEST(PushEncoder, TakesAnotherMeshBetweenFrames) {
  Stream stream;
  Encoder encoder({}, into(stream));
  ASSERT_TRUE(encoder.set_mesh(kSquare).ok());
  ASSERT_TRUE(encoder.add_frame(square_frame(0)).ok());
  ASSERT_TRUE(encoder.add_frame(square_frame(1)).ok());
  ASSERT_TRUE(encoder.set_mesh(kTriangle).ok());
  ASSERT_TRUE(encoder.add_frame(FramePositions(9, 0.5F)).ok());
  const Result<EncodeReport> report = encoder.finish();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->frames, 3U);
  EXPECT_EQ(report->gops, 2U);
  const Decoded decoded = decode(stream);
  EXPECT_TRUE(decoded.whole);
  EXPECT_EQ(decoded.vertices, (std::vector<std::uint32_t>{4, 4, 3}));
}

TEST(PushEncoder, RefusesAMeshAboveItsBoundsAndGoesOn) {
  Stream stream;
  Encoder encoder({}, into(stream));
  ASSERT_TRUE(encoder.set_mesh(kTriangle).ok());
  ASSERT_TRUE(encoder.add_frame(FramePositions(9, 0.0F)).ok());
  const Status larger = encoder.set_mesh(kSquare);
  ASSERT_FALSE(larger.ok());
  EXPECT_EQ(larger.error().code, ErrorCode::kLimitExceeded);
  ASSERT_TRUE(encoder.add_frame(FramePositions(9, 1.0F)).ok());
  ASSERT_TRUE(encoder.finish());
  EXPECT_EQ(decode(stream).vertices.size(), 2U);
}

TEST(PushEncoder, TakesALargerMeshWhereItsBoundsWereNamed) {
  Stream stream;
  EncodeOptions options;
  options.max_vertices = 4;
  options.max_faces = 2;
  Encoder encoder(options, into(stream));
  ASSERT_TRUE(encoder.set_mesh(kTriangle).ok());
  ASSERT_TRUE(encoder.add_frame(FramePositions(9, 0.0F)).ok());
  ASSERT_TRUE(encoder.set_mesh(kSquare).ok());
  ASSERT_TRUE(encoder.add_frame(square_frame(0)).ok());
  ASSERT_TRUE(encoder.finish());
  EXPECT_EQ(decode(stream).vertices, (std::vector<std::uint32_t>{3, 4}));
}

TEST(PushEncoder, SaysWhatComesOutOfTurn) {
  Stream stream;
  Encoder encoder({}, into(stream));
  EXPECT_EQ(encoder.add_frame(square_frame(0)).error().code, ErrorCode::kWrongState);
  ASSERT_TRUE(encoder.set_mesh(kSquare).ok());
  EXPECT_EQ(encoder.set_mesh(kTriangle).error().code, ErrorCode::kWrongState);
  EXPECT_EQ(encoder.add_frame(FramePositions(9)).error().code, ErrorCode::kInvalidArgument);
  ASSERT_TRUE(encoder.add_frame(square_frame(0)).ok());
  ASSERT_TRUE(encoder.finish());
  EXPECT_EQ(encoder.add_frame(square_frame(1)).error().code, ErrorCode::kWrongState);
  EXPECT_TRUE(decode(stream).whole);
}

TEST(PushEncoder, KeepsTheSinksError) {
  EncodeOptions options;
  options.gop_frames = 1;
  int calls = 0;
  Encoder encoder(options, [&calls](std::span<const std::uint8_t>) {
    return ++calls < 4 ? Status() : Status(Error{ErrorCode::kIo, "the disk is full"});
  });
  ASSERT_TRUE(encoder.set_mesh(kSquare).ok());
  EXPECT_EQ(encoder.add_frame(square_frame(0)).error().code, ErrorCode::kIo);
  EXPECT_EQ(encoder.add_frame(square_frame(1)).error().code, ErrorCode::kIo);
  EXPECT_EQ(encoder.finish().error().message, "the disk is full");
}

TEST(PushEncoder, PassesThroughWhatTheSinkThrows) {
  Encoder encoder({}, [](std::span<const std::uint8_t>) -> Status { throw std::runtime_error("gone"); });
  EXPECT_THROW((void)encoder.set_mesh(kSquare), std::runtime_error);
}

}  // namespace
}  // namespace tvg
