#include "c_api_toolbox.hpp"

#include <array>
#include <cstring>
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

/// `largest_error` becomes what the report says.
Stream encode_in_c(const Sequence& sequence, const tvg_encoder_options& options,
                   double* largest_error = nullptr) {
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
  if (largest_error != nullptr) *largest_error = report.largest_error;
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

TEST(CEncoder, EncodesWithoutLossAndTheDecoderSaysSo) {
  Sequence sequence = toy();
  sequence.metadata.clear();
  EncodeOptions expected;
  expected.gop_frames = 5;
  expected.mode = Mode::kLossless;
  tvg_encoder_options options = usual();
  options.mode = TVG_MODE_LOSSLESS;
  const Stream stream = encode_in_c(sequence, options);
  EXPECT_EQ(stream, encode_sequence(sequence, expected));
  std::unique_ptr<tvg_decoder, decltype(&tvg_decoder_destroy)> decoder(tvg_decoder_create(nullptr),
                                                                       &tvg_decoder_destroy);
  ASSERT_EQ(tvg_decoder_push(decoder.get(), stream.data(), stream.size()), TVG_OK);
  while (tvg_decoder_poll(decoder.get()) != TVG_EVENT_FRAME) {
  }
  tvg_gop_info gop = {};
  gop.struct_size = sizeof gop;
  ASSERT_EQ(tvg_decoder_get_gop(decoder.get(), &gop), TVG_OK);
  EXPECT_EQ(gop.mode, std::uint32_t{TVG_MODE_LOSSLESS});
  EXPECT_EQ(gop.fine_step, 0);
  FramePositions back(sequence.frames[0].size());
  ASSERT_EQ(tvg_decoder_copy_positions(decoder.get(), back.data(), 4 * back.size(), 12), TVG_OK);
  EXPECT_EQ(std::memcmp(back.data(), sequence.frames[0].data(), 4 * back.size()), 0);
}

EncodeOptions basis_of_toy() {
  EncodeOptions expected;
  expected.mode = Mode::kBasis;
  expected.gop_frames = 5;
  expected.period_frames = 9;
  expected.effort = 3;
  return expected;
}

tvg_encoder_options basis_of_toy_in_c() {
  tvg_encoder_options options = usual();
  options.mode = TVG_MODE_BASIS;
  options.period_frames = 9;
  options.effort = 3;
  return options;
}

TEST(CEncoder, EncodesABasisWithItsPeriodEffortAndLargestError) {
  Sequence sequence = toy();
  sequence.metadata.clear();
  EncodeOptions expected = basis_of_toy();
  tvg_encoder_options options = basis_of_toy_in_c();
  expected.box = box_around(sequence.frames);
  options.has_box = 1;
  std::copy(expected.box->low().begin(), expected.box->low().end(), options.box_low);
  std::copy(expected.box->high().begin(), expected.box->high().end(), options.box_high);
  EXPECT_EQ(encode_in_c(sequence, options), encode_sequence(sequence, expected));
  options.max_error = 0.01 * expected.box->diagonal();
  double reported = 0;
  const Stream stream = encode_in_c(sequence, options, &reported);
  EXPECT_GT(reported, 0);
  EXPECT_LE(reported, options.max_error);
  for (const DecodedFrame& frame : decode_stream(stream).frames) {
    const FramePositions& original = sequence.frames[frame.number];
    for (std::size_t i = 0; i < original.size(); ++i)
      ASSERT_LE(std::abs(double{frame.positions[i]} - double{original[i]}),
                reported + std::abs(original[i]) * 0x1p-22);
  }
}

TEST(CEncoder, AnEffortOf0IsTheUsualOneAndOptionsOutOfRangeAreRefused) {
  const Sequence sequence = toy();
  tvg_encoder_options options = basis_of_toy_in_c();
  EXPECT_EQ(usual().effort, 5u);
  options.effort = 0;
  const Stream stream = encode_in_c(sequence, options);
  options.effort = 5;
  EXPECT_EQ(encode_in_c(sequence, options), stream);
  const auto refused = [&sequence](tvg_encoder_options wrong) {
    Stream ignored;
    const OwnedEncoder encoder = make(wrong, append, &ignored);
    const Mesh& mesh = sequence.mesh;
    return tvg_encoder_set_mesh(encoder.get(), mesh.vertex_count, corners(mesh),
                                static_cast<std::uint32_t>(mesh.faces.size())) == TVG_ERROR_INVALID_ARGUMENT;
  };
  EXPECT_FALSE(refused(options));
  tvg_encoder_options wrong = options;
  wrong.effort = 10;
  EXPECT_TRUE(refused(wrong));
  wrong = options;
  wrong.period_frames = 65537;
  EXPECT_TRUE(refused(wrong));
  for (const double error :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    wrong = options;
    wrong.max_error = error;
    EXPECT_TRUE(refused(wrong)) << error;
  }
  wrong = options;
  wrong.max_error = wrong.step = 0.1;
  EXPECT_TRUE(refused(wrong));
}

TEST(CEncoder, OfABasisTheDecoderSaysHowManyComponentsItHasAndUsesAsManyAsItIsTold) {
  const Sequence sequence = toy();
  const Stream stream = encode_in_c(sequence, basis_of_toy_in_c());
  const auto first_frame = [&](std::uint32_t components, tvg_gop_info& gop) {
    StreamDecoder decoder;
    EXPECT_EQ(decoder.use_components(components), TVG_OK);
    EXPECT_EQ(decoder.push(stream.data(), stream.size()), TVG_OK);
    tvg_event event = decoder.poll();
    while (event != TVG_EVENT_FRAME && event != TVG_EVENT_NEED_BYTES) event = decoder.poll();
    EXPECT_EQ(event, TVG_EVENT_FRAME);
    gop = *decoder.gop();
    EXPECT_EQ(decoder.frame()->predictor, std::uint32_t{TVG_PREDICTOR_ROWS});
    return current_c_frame(decoder).positions;
  };
  tvg_gop_info gop = {};
  const std::vector<float> whole = first_frame(kMaxComponents, gop);
  EXPECT_EQ(gop.mode, std::uint32_t{TVG_MODE_BASIS});
  EXPECT_GT(gop.components, 4u);
  EXPECT_EQ(first_frame(gop.components, gop), whole);
  EXPECT_NE(first_frame(4, gop), whole);
  EXPECT_EQ(tvg_decoder_use_components(nullptr, 1), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_use_lod(nullptr, 1), TVG_ERROR_INVALID_ARGUMENT);
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
