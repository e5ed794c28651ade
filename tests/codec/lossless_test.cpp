#include "codec_toolbox.hpp"
#include "corpus/corpus.hpp"
#include "real_sequences.hpp"
#include "tests/connectivity/mesh_builders.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/survey.hpp>

// Mode lossless: every bit of every position comes back.
namespace tvg::test {
namespace {

EncodeOptions lossless(std::uint32_t gop_frames = 4) {
  EncodeOptions options;
  options.mode = Mode::kLossless;
  options.gop_frames = gop_frames;
  return options;
}

/// Encodes, decodes and compares bits; returns the size of the stream.
std::size_t expect_all_bits(const Sequence& sequence, const EncodeOptions& options) {
  const Stream stream = encode_sequence(sequence, options);
  const DecodedStream back = decode_stream(stream);
  EXPECT_TRUE(back.complete && back.damage.empty());
  EXPECT_EQ(back.frames.size(), sequence.frames.size());
  for (std::size_t f = 0; f < back.frames.size(); ++f) {
    const FramePositions& given = sequence.frames[f];
    const DecodedFrame& frame = back.frames[f];
    EXPECT_EQ(frame.positions.size(), given.size());
    EXPECT_EQ(std::memcmp(frame.positions.data(), given.data(), given.size() * sizeof(float)), 0)
        << "frame " << f;
    EXPECT_EQ(frame.gop.mode, Mode::kLossless);
    for (std::size_t i = 0; i < given.size(); ++i) {
      const auto bits = std::bit_cast<std::int32_t>(given[i]);
      EXPECT_EQ(frame.lattice[i], bits >= 0 ? bits : -1 - (bits & 0x7FFFFFFF));
    }
    EXPECT_EQ(frame.flags, std::vector<std::uint8_t>(given.size() / 3, 1));
  }
  return stream.size();
}

/// A sequence of a mesh whose coordinates a function chooses.
template <class Choose>
Sequence sequence_of(Mesh mesh, std::size_t frame_count, const Choose& choose) {
  Sequence sequence{std::move(mesh), {}, {}};
  for (std::size_t f = 0; f < frame_count; ++f) {
    sequence.frames.emplace_back(3 * std::size_t{sequence.mesh.vertex_count});
    for (float& x : sequence.frames.back()) x = choose();
  }
  return sequence;
}

TEST(LosslessMode, GivesBackEverySequenceOfTheCorpus) {
  for (const corpus::CorpusEntry& entry : corpus::corpus_entries())
    expect_all_bits(entry.make({300, 10}).sequence, lossless());
}

TEST(LosslessMode, GivesBackAnyFiniteNumbers) {
  std::mt19937 random(7);
  const auto any = [&random] {
    for (;;) {
      const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
      if (std::isfinite(x)) return x;
    }
  };
  expect_all_bits(sequence_of(grid(9, 8), 9, any), lossless());
}

TEST(LosslessMode, GivesBackZerosOfBothSignsDenormalAndHugeNumbers) {
  std::mt19937 random(8);
  constexpr float kLargest = std::numeric_limits<float>::max(), kLeast = 0x1p-149F;
  const std::vector<float> numbers = {0.0F,     -0.0F,     kLeast, -kLeast, 0x1p-126F, -0x1.8p-127F,
                                      kLargest, -kLargest, 1.0F,   -1.0F,   1e-30F,    0x1p127F};
  expect_all_bits(sequence_of(grid(7, 6), 7, [&] { return numbers[random() % numbers.size()]; }), lossless());
  for (const float x : numbers) expect_all_bits(sequence_of(grid(3, 3), 3, [x] { return x; }), lossless());
}

TEST(LosslessMode, GivesBackASingleVertexAndVerticesAtOnePlace) {
  std::mt19937 random(9);
  const auto near = [&random] { return 1000 + static_cast<float>(random() % 1000) / 7; };
  expect_all_bits(sequence_of(Mesh{1, {}}, 6, near), lossless());
  expect_all_bits(sequence_of(Mesh{2, {{0, 1, 1}}}, 6, near), lossless());
  expect_all_bits(sequence_of(grid(5, 5), 4, [] { return 0.3F; }), lossless());
}

TEST(LosslessMode, TakesLittleForNumbersThatHaveLittleInThem) {
  const Sequence full = corpus::find_corpus_entry("cloth")->make({600, 20}).sequence;
  const std::size_t size = expect_all_bits(full, lossless(20));
  Sequence half = full, fixed = full, whole = full;
  for (std::size_t f = 0; f < full.frames.size(); ++f) {
    for (std::size_t i = 0; i < full.frames[f].size(); ++i) {
      const float x = full.frames[f][i];
      half.frames[f][i] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & 0xFFFFE000u);
      fixed.frames[f][i] = std::nearbyint(x * 4096) / 4096;
      whole.frames[f][i] = std::nearbyint(x * 64) * 65536;
    }
  }
  EXPECT_LT(expect_all_bits(half, lossless(20)), size / 2);
  EXPECT_LT(expect_all_bits(fixed, lossless(20)), size / 3);
  EXPECT_LT(expect_all_bits(whole, lossless(20)), size / 5);
}

TEST(LosslessMode, GivesBackRealSequencesInFarLessThanTheyHave) {
  const std::vector<RealSequence> sequences = real_sequences(40);
  if (sequences.empty()) GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  for (const auto& [name, sequence] : sequences) {
    const double coordinates = 3.0 * sequence.mesh.vertex_count * static_cast<double>(sequence.frames.size());
    const double bits = 8 * static_cast<double>(expect_all_bits(sequence, lossless(50))) / coordinates;
    EXPECT_LT(bits, 18.1) << name;
  }
}

TEST(LosslessMode, TheBytesDoNotDependOnTheNumberOfThreadsNorTheFramesOnThePieces) {
  const Sequence sequence = corpus::find_corpus_entry("hand")->make({400, 14}).sequence;
  EncodeOptions options = lossless(3);
  const Stream one = encode_sequence(sequence, options);
  options.threads = 4;
  EXPECT_EQ(encode_sequence(sequence, options), one);
  expect_same_frames(decode_stream(one), decode_pieces(one, [] { return 101; }));
}

TEST(LosslessMode, EachMeshOfAStreamIsCodedAlike) {
  std::mt19937 random(5);
  Stream stream;
  EncodeOptions options = lossless();
  options.max_vertices = 500;
  options.max_faces = 1000;
  options.keep_vertex_order = true;
  Encoder encoder(options, [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  const std::vector<Sequence> sequences = {random_sequence(grid(10, 12), 5, random),
                                           random_sequence(closed_surface(9, 7), 3, random)};
  std::vector<FramePositions> given;
  for (const Sequence& sequence : sequences) {
    ASSERT_TRUE(encoder.set_mesh(sequence.mesh).ok());
    for (const FramePositions& frame : sequence.frames) {
      ASSERT_TRUE(encoder.add_frame(frame).ok());
      given.push_back(frame);
    }
  }
  ASSERT_TRUE(encoder.finish());
  const DecodedStream back = decode_stream(stream);
  ASSERT_TRUE(back.complete && back.damage.empty());
  ASSERT_EQ(back.frames.size(), given.size());
  for (std::size_t f = 0; f < given.size(); ++f) EXPECT_EQ(back.frames[f].positions, given[f]);
}

TEST(LosslessMode, RefusesWhatItCannotGiveBackAndOptionsThatHaveNoSayInIt) {
  Sequence sequence = corpus::find_corpus_entry("cloth")->make({100, 2}).sequence;
  const auto code_of = [&sequence](const EncodeOptions& options) {
    SequenceSource source(sequence);
    const Result<Stream> stream = try_encode(source, options);
    return stream ? ErrorCode{} : stream.error().code;
  };
  EncodeOptions two = lossless(), step = lossless(), predictor = lossless(), pyramid = lossless();
  two.coarse_bits = 9;
  step.step = 0.25;
  predictor.predictor = Predictor::kAuto;
  pyramid.predictor = Predictor::kPyramid;
  EXPECT_EQ(code_of(two), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of(step), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of(predictor), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of(pyramid), ErrorCode{});
  for (const float x : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    sequence.frames[1][4] = x;
    EXPECT_EQ(code_of(lossless()), ErrorCode::kInvalidInput);
  }
}

TEST(LosslessMode, AddsUpTheBitsOfTheThreeAxesAndTellsTheModeWithoutDecoding) {
  const Stream stream =
      encode_sequence(corpus::find_corpus_entry("cloth")->make({300, 6}).sequence, lossless());
  Decoder decoder;
  decoder.measure_bits(true);
  decoder.push(stream);
  decoder.finish();
  std::size_t frames = 0;
  for (Decoder::Event event = decoder.poll(); event != Decoder::Event::kEnd; event = decoder.poll()) {
    ASSERT_NE(event, Decoder::Event::kError);
    if (event != Decoder::Event::kFrame) continue;
    ++frames;
    const auto& bits = decoder.frame_bits();
    const double whole = 8.0 * static_cast<double>(decoder.frame_bytes());
    EXPECT_NEAR(bits[0] + bits[1] + bits[2], whole, 80);
  }
  EXPECT_EQ(frames, 6u);
  const auto read = [&stream](std::uint64_t offset, std::span<std::uint8_t> target) -> Result<std::size_t> {
    const std::size_t count = std::min<std::size_t>(target.size(), stream.size() - offset);
    std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(offset), count, target.begin());
    return count;
  };
  const Result<StreamSurvey> found = survey(read, stream.size());
  ASSERT_TRUE(found);
  ASSERT_EQ(found->gops.size(), 2u);
  EXPECT_EQ(found->gops[0].mode, Mode::kLossless);
}

}  // namespace
}  // namespace tvg::test
