#include "c_api_toolbox.hpp"

#include <array>

#include <tvg/stream_encoder.hpp>

// The owner of the C interface's encoder.
namespace tvg::test {
namespace {

StreamEncoder::Sink into(Stream& stream) {
  return [&stream](const void* bytes, std::size_t size) {
    const auto* const first = static_cast<const std::uint8_t*>(bytes);
    stream.insert(stream.end(), first, first + size);
    return true;
  };
}

constexpr std::array<std::uint32_t, 6> kFaces = {0, 1, 2, 0, 2, 3};
constexpr std::array<float, 12> kFrame = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

TEST(StreamEncoder, WritesWhatTheOwnerOfADecoderReads) {
  Stream stream;
  tvg_encoder_options options = {};
  options.struct_size = sizeof options;
  ASSERT_EQ(tvg_encoder_options_init(&options), TVG_OK);
  options.gop_frames = 2;
  StreamEncoder encoder(into(stream), &options);
  ASSERT_TRUE(encoder);
  EXPECT_EQ(encoder.set_metadata("fps", "25"), TVG_OK);
  EXPECT_EQ(encoder.set_mesh(4, kFaces.data(), 2), TVG_OK);
  for (int frame = 0; frame < 5; ++frame) EXPECT_EQ(encoder.add_frame(kFrame.data(), 12), TVG_OK);
  const auto report = encoder.finish();
  ASSERT_TRUE(report) << encoder.error_text();
  EXPECT_EQ(report->frames, 5u);
  EXPECT_EQ(report->gops, 3u);
  EXPECT_EQ(report->bytes, stream.size());
  EXPECT_EQ(decode_all(stream, 100).size(), 5u);
}

TEST(StreamEncoder, MovesWithItsSink) {
  Stream stream;
  StreamEncoder first(into(stream));
  ASSERT_EQ(first.set_mesh(4, kFaces.data(), 2), TVG_OK);
  StreamEncoder second = std::move(first);
  EXPECT_EQ(second.add_frame(kFrame.data(), 12), TVG_OK);
  ASSERT_TRUE(second.finish());
  EXPECT_EQ(decode_all(stream, stream.size()).size(), 1u);
}

TEST(StreamEncoder, ASinkThatReturnsFalseGivesUp) {
  StreamEncoder encoder([](const void*, std::size_t) { return false; });
  EXPECT_EQ(encoder.set_mesh(4, kFaces.data(), 2), TVG_ERROR_IO);
  EXPECT_FALSE(encoder.finish());
  EXPECT_NE(encoder.error_text(), "");
}

}  // namespace
}  // namespace tvg::test
