#include "c_api_toolbox.hpp"

#include <array>
#include <limits>
#include <memory>
#include <random>

// Encoding, comparing and joining through the C interface.
namespace tvg::test {
namespace {

struct Destroy {
  void operator()(tvg_encoder* encoder) const { tvg_encoder_destroy(encoder); }
  void operator()(tvg_comparer* comparer) const { tvg_comparer_destroy(comparer); }
};
using OwnedEncoder = std::unique_ptr<tvg_encoder, Destroy>;

int append(void* user, const void* bytes, std::size_t size) {
  const auto* const first = static_cast<const std::uint8_t*>(bytes);
  static_cast<Stream*>(user)->insert(static_cast<Stream*>(user)->end(), first, first + size);
  return 0;
}

int give_up(void*, const void*, std::size_t) {
  return 1;
}

const std::uint32_t* corners(const Mesh& mesh) {
  return mesh.faces.front().data();
}

Sequence toy() {
  return corpus::find_corpus_entry("toy")->make(*corpus::named_size("small")).sequence;
}

tvg_encoder_options usual() {
  tvg_encoder_options options = {};
  options.struct_size = sizeof options;
  EXPECT_EQ(tvg_encoder_options_init(&options), TVG_OK);
  options.gop_frames = 5;
  return options;
}

OwnedEncoder make(const tvg_encoder_options& options, tvg_sink sink, void* user) {
  tvg_encoder* encoder = nullptr;
  EXPECT_EQ(tvg_encoder_create(&options, sink, user, &encoder), TVG_OK);
  return OwnedEncoder(encoder);
}

Stream encode_in_c(const Sequence& sequence, const tvg_encoder_options& options) {
  Stream stream;
  const OwnedEncoder encoder = make(options, append, &stream);
  const Mesh& mesh = sequence.mesh;
  EXPECT_EQ(tvg_encoder_set_mesh(encoder.get(), mesh.vertex_count, corners(mesh),
                                 static_cast<std::uint32_t>(mesh.faces.size())),
            TVG_OK);
  for (const FramePositions& frame : sequence.frames) {
    EXPECT_EQ(tvg_encoder_add_frame(encoder.get(), frame.data(), 4 * frame.size(), 12), TVG_OK)
        << tvg_encoder_error_text(encoder.get());
  }
  tvg_encode_report report = {};
  report.struct_size = sizeof report;
  EXPECT_EQ(tvg_encoder_finish(encoder.get(), &report), TVG_OK);
  EXPECT_EQ(report.bytes, stream.size());
  EXPECT_EQ(report.frames, sequence.frames.size());
  return stream;
}

TEST(CEncoder, BytesAreThoseOfEncodeAndDoNotDependOnThreads) {
  Sequence sequence = toy();
  sequence.metadata.clear();
  EncodeOptions expected;
  expected.gop_frames = 5;
  expected.fine_bits = 13;
  const BoundingBox box = box_around(sequence.frames);
  tvg_encoder_options options = usual();
  options.fine_bits = 13;
  options.has_box = 1;
  std::copy(box.low().begin(), box.low().end(), options.box_low);
  std::copy(box.high().begin(), box.high().end(), options.box_high);
  for (const std::uint32_t threads : {1u, 2u, 5u}) {
    options.threads = threads;
    EXPECT_EQ(encode_in_c(sequence, options), encode_sequence(sequence, expected)) << threads;
  }
}

TEST(CEncoder, WhatComesOutOfTurnIsAWrongStateAndChangesNothing) {
  const Sequence sequence = toy();
  const Mesh& mesh = sequence.mesh;
  const auto faces = static_cast<std::uint32_t>(mesh.faces.size());
  const FramePositions& frame = sequence.frames[0];
  Stream stream;
  const OwnedEncoder encoder = make(usual(), append, &stream);
  EXPECT_EQ(tvg_encoder_finish(encoder.get(), nullptr), TVG_ERROR_WRONG_STATE);
  EXPECT_EQ(tvg_encoder_add_frame(encoder.get(), frame.data(), 4 * frame.size(), 12), TVG_ERROR_WRONG_STATE);
  EXPECT_EQ(tvg_encoder_set_mesh(encoder.get(), 1, corners(mesh), faces), TVG_ERROR_INVALID_INPUT);
  EXPECT_EQ(tvg_encoder_set_metadata(encoder.get(), "fps", "25"), TVG_OK);
  EXPECT_EQ(tvg_encoder_set_mesh(encoder.get(), mesh.vertex_count, corners(mesh), faces), TVG_OK);
  EXPECT_EQ(tvg_encoder_set_mesh(encoder.get(), mesh.vertex_count, corners(mesh), faces),
            TVG_ERROR_WRONG_STATE);
  EXPECT_EQ(tvg_encoder_set_metadata(encoder.get(), "fps", "30"), TVG_ERROR_WRONG_STATE);
  EXPECT_EQ(tvg_encoder_finish(encoder.get(), nullptr), TVG_ERROR_INVALID_INPUT);
  EXPECT_EQ(tvg_encoder_add_frame(encoder.get(), frame.data(), 4 * frame.size() - 1, 12),
            TVG_ERROR_INVALID_ARGUMENT);
  FramePositions broken = frame;
  broken[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(tvg_encoder_add_frame(encoder.get(), broken.data(), 4 * frame.size(), 12),
            TVG_ERROR_INVALID_INPUT);
  EXPECT_EQ(tvg_encoder_add_frame(encoder.get(), frame.data(), 4 * frame.size(), 12), TVG_OK);
  EXPECT_EQ(tvg_encoder_set_mesh(encoder.get(), mesh.vertex_count + 1, corners(mesh), faces),
            TVG_ERROR_LIMIT_EXCEEDED);
  EXPECT_EQ(tvg_encoder_set_mesh(encoder.get(), mesh.vertex_count, corners(mesh), faces), TVG_OK);
  EXPECT_EQ(tvg_encoder_add_frame(encoder.get(), frame.data(), 4 * frame.size(), 12), TVG_OK);
  EXPECT_EQ(tvg_encoder_finish(encoder.get(), nullptr), TVG_OK);
  EXPECT_EQ(tvg_encoder_finish(encoder.get(), nullptr), TVG_ERROR_WRONG_STATE);
  const DecodedStream back = decode_stream(stream);
  EXPECT_TRUE(back.complete && back.damage.empty());
  EXPECT_EQ(back.frames.size(), 2u);
  EXPECT_EQ(back.metadata.at("fps"), "25");
}

TEST(CEncoder, ASinkThatGivesUpLosesTheStream) {
  const Sequence sequence = toy();
  const OwnedEncoder encoder = make(usual(), give_up, nullptr);
  const auto set = [&] {
    return tvg_encoder_set_mesh(encoder.get(), sequence.mesh.vertex_count, corners(sequence.mesh),
                                static_cast<std::uint32_t>(sequence.mesh.faces.size()));
  };
  EXPECT_EQ(set(), TVG_ERROR_IO);
  EXPECT_EQ(set(), TVG_ERROR_IO);
  EXPECT_EQ(tvg_encoder_finish(encoder.get(), nullptr), TVG_ERROR_IO);
}

TEST(CEncoder, JoinsAndCompares) {
  const Sequence sequence = toy();
  const Stream one = encode_in_c(sequence, usual());
  const std::array<tvg_stream_bytes, 2> both = {{{one.data(), one.size()}, {one.data(), one.size()}}};
  Stream joined;
  std::array<char, 200> text;
  ASSERT_EQ(tvg_join(both.data(), 2, append, &joined, nullptr, text.data(), text.size()), TVG_OK)
      << text.data();
  const DecodedStream back = decode_stream(joined);
  ASSERT_EQ(back.frames.size(), 2 * sequence.frames.size());
  const tvg_stream_bytes cut = {one.data(), one.size() / 2};
  EXPECT_NE(tvg_join(&cut, 1, append, &joined, nullptr, text.data(), text.size()), TVG_OK);
  EXPECT_NE(text[0], '\0');

  tvg_comparer* made = nullptr;
  ASSERT_EQ(tvg_comparer_create(sequence.mesh.vertex_count, corners(sequence.mesh),
                                static_cast<std::uint32_t>(sequence.mesh.faces.size()), &made),
            TVG_OK);
  const std::unique_ptr<tvg_comparer, Destroy> comparer(made);
  for (std::size_t f = 0; f < sequence.frames.size(); ++f) {
    EXPECT_EQ(tvg_comparer_add_frame(made, sequence.frames[f].data(), back.frames[f].positions.data(),
                                     sequence.frames[f].size()),
              TVG_OK);
  }
  tvg_comparison comparison = {};
  comparison.struct_size = sizeof comparison;
  ASSERT_EQ(tvg_comparer_get(made, &comparison), TVG_OK);
  EXPECT_EQ(comparison.frames, sequence.frames.size());
  EXPECT_GT(comparison.rms_distance, 0);
  EXPECT_LT(comparison.max_distance, comparison.diagonal / 1000);
}

TEST(CEncoder, CodesOfAnyNumberHaveAName) {
  for (const int code : {-1, 0, 11, 40, 99, std::numeric_limits<int>::max()}) {
    EXPECT_STRNE(tvg_code_name(code), "");
  }
  EXPECT_STREQ(tvg_code_name(99), "unknown");
}

}  // namespace
}  // namespace tvg::test
