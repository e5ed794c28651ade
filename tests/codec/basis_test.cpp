#include "codec_toolbox.hpp"
#include "corpus/corpus.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <vector>

// Mode basis through the public interface (format-spec §7.8).
namespace tvg::test {
namespace {

EncodeOptions basis_options(int bits, std::uint32_t period = 8, std::uint32_t gop = 4) {
  EncodeOptions options;
  options.mode = Mode::kBasis;
  options.fine_bits = options.coarse_bits = bits;
  options.period_frames = period;
  options.gop_frames = gop;
  return options;
}

Sequence corpus_sequence(const std::string& name) {
  return corpus::find_corpus_entry(name)->make(*corpus::named_size("small")).sequence;
}

double largest_extent(const Sequence& sequence) {
  BoundingBox box;
  for (const FramePositions& frame : sequence.frames) box.extend(frame);
  return box.largest_extent();
}

struct Errors {
  double rms = 0;  ///< of coordinates
  double largest = 0;
};

/// Of the vertices with this flag, or of all.
Errors errors_of(const Sequence& sequence, const DecodedStream& back, int flag = -1) {
  Errors errors;
  double sum = 0, count = 0;
  for (const DecodedFrame& frame : back.frames) {
    const FramePositions& original = sequence.frames[frame.number];
    for (std::size_t i = 0; i < original.size(); ++i) {
      if (flag >= 0 && frame.flags[i / 3] != flag) continue;
      const double missed = double{frame.positions[i]} - double{original[i]};
      sum += missed * missed;
      ++count;
      errors.largest = std::max(errors.largest, std::abs(missed));
    }
  }
  errors.rms = std::sqrt(sum / std::max(count, 1.0));
  return errors;
}

DecodedStream expect_whole(const Sequence& sequence, const Stream& stream) {
  DecodedStream back = decode_stream(stream);
  EXPECT_TRUE(back.complete) << back.error.describe();
  EXPECT_TRUE(back.damage.empty());
  EXPECT_EQ(back.frames.size(), sequence.frames.size());
  return back;
}

TEST(ModeBasis, HasTheErrorOfTheLatticeOnAverageAndNoMore) {
  for (const char* name : {"hand", "face", "cloth", "toy"}) {
    const Sequence sequence = corpus_sequence(name);
    for (const int bits : {8, 11, 14}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(bits));
      const DecodedStream back =
          expect_whole(sequence, encode_sequence(sequence, basis_options(bits, 12, 5)));
      const double step = std::ldexp(largest_extent(sequence), -bits);
      EXPECT_LE(errors_of(sequence, back).rms, step / std::sqrt(12.0) * 1.001);
    }
  }
}

TEST(ModeBasis, IsFarSmallerThanModeElp) {
  const Sequence sequence = corpus::make_hand({1500, 48}).sequence;
  EXPECT_LT(2 * encode_sequence(sequence, basis_options(11, 48, 48)).size(),
            encode_sequence(sequence, EncodeOptions()).size());
}

TEST(ModeBasis, HonoursTheLargestErrorOnEveryCoordinate) {
  for (const char* name : {"hand", "cloth", "toy", "soup"}) {
    const Sequence sequence = corpus_sequence(name);
    BoundingBox box;
    for (const FramePositions& frame : sequence.frames) box.extend(frame);
    for (const double share : {0.01, 0.0005}) {
      for (const Mode mode : {Mode::kElp, Mode::kBasis}) {
        SCOPED_TRACE(std::string(name) + " " + std::to_string(share));
        EncodeOptions options = basis_options(11);
        options.mode = mode;
        options.max_error = ErrorBound{share, true};
        const DecodedStream back = expect_whole(sequence, encode_sequence(sequence, options));
        EXPECT_LE(errors_of(sequence, back).largest, share * box.diagonal());
        options.max_error = ErrorBound{share * box.diagonal(), false};
        EXPECT_EQ(encode_sequence(sequence, options).size(), encode_sequence(sequence, options).size());
      }
    }
  }
}

TEST(ModeBasis, RefusesErrorsThatCoordinatesDoNotResolve) {
  const Sequence sequence = corpus_sequence("hand");
  EncodeOptions options = basis_options(11);
  options.max_error = ErrorBound{1e-12, false};
  SequenceSource source(sequence);
  const Result<Stream> stream = try_encode(source, options);
  ASSERT_FALSE(stream);
  EXPECT_EQ(stream.error().code, ErrorCode::kInvalidArgument);
}

TEST(ModeBasis, GivesImportantVerticesTheErrorOfTheirLattice) {
  const Sequence sequence = corpus_sequence("hand");
  EncodeOptions options = basis_options(12, 12, 6);
  options.coarse_bits = 9;
  options.importance.share = 0.3;
  const DecodedStream back = expect_whole(sequence, encode_sequence(sequence, options));
  const double step = std::ldexp(largest_extent(sequence), -12);
  const Errors important = errors_of(sequence, back, 1), others = errors_of(sequence, back, 0);
  EXPECT_LT(important.rms, 2 * step / std::sqrt(12.0));
  EXPECT_LT(others.rms, 8 * step / std::sqrt(12.0) * 1.1);
  EXPECT_GT(others.rms, 3 * important.rms);
}

TEST(ModeBasis, IsTheSameWhateverTheNumberOfThreads) {
  const Sequence sequence = corpus_sequence("cloth");
  EncodeOptions options = basis_options(10, 4, 2);
  const Stream one = encode_sequence(sequence, options);
  options.threads = 3;
  EXPECT_EQ(encode_sequence(sequence, options), one);
}

TEST(ModeBasis, DecodesTheSameFramesFromPiecesOfAnySize) {
  const Sequence sequence = corpus_sequence("hand");
  const Stream stream = encode_sequence(sequence, basis_options(11, 6, 3));
  std::mt19937 random(11);
  const DecodedStream pieces = decode_pieces(stream, [&random] { return random() % 200; });
  expect_same_frames(pieces, decode_stream(stream));
}

TEST(ModeBasis, GivesAnyFrameByASeek) {
  const Sequence sequence = corpus_sequence("hand");
  const Stream stream = encode_sequence(sequence, basis_options(11, 6, 3));
  const DecodedStream whole = decode_stream(stream);
  ASSERT_EQ(whole.frames.size(), sequence.frames.size());
  for (std::size_t frame = whole.frames.size(); frame-- > 0;) {
    Decoder decoder;
    decoder.push(std::span(stream).first(200));
    DecodedStream start;
    drain(decoder, start);
    decoder.set_index(whole.index);
    const Result<std::uint64_t> offset = decoder.seek(frame);
    ASSERT_TRUE(offset);
    decoder.push(std::span(stream).subspan(static_cast<std::size_t>(*offset)));
    DecodedStream rest;
    drain(decoder, rest);
    ASSERT_FALSE(rest.frames.empty());
    ASSERT_TRUE(rest.damage.empty());
    EXPECT_EQ(rest.frames.front().number, frame);
    EXPECT_EQ(rest.frames.front().positions, whole.frames[frame].positions);
  }
}

TEST(ModeBasis, ErrorFallsWithTheComponentsThatADecoderUses) {
  const Sequence sequence = corpus_sequence("cloth");
  const Stream stream = encode_sequence(sequence, basis_options(12, 12, 5));
  const DecodedStream whole = decode_stream(stream);
  const std::uint32_t components = whole.frames.front().gop.components;
  ASSERT_GT(components, 8u);
  const auto decode_with = [&stream](std::uint32_t most) {
    Decoder decoder;
    decoder.use_components(most);
    decoder.push(stream);
    decoder.finish();
    DecodedStream decoded;
    drain(decoder, decoded);
    return decoded;
  };
  double before = std::numeric_limits<double>::infinity();
  for (std::uint32_t most = 0; most < components + 4; most += 4) {
    const DecodedStream coarse = decode_with(most);
    EXPECT_TRUE(coarse.complete && coarse.damage.empty());
    ASSERT_EQ(coarse.frames.size(), sequence.frames.size());
    const double error = errors_of(sequence, coarse).rms;
    EXPECT_LT(error, before) << most;
    before = error;
  }
  expect_same_frames(decode_with(components), whole);
  expect_same_frames(decode_with(1), decode_with(4));
}

/// Sequences in which there is little or nothing to find a basis of.
std::vector<std::pair<std::string, Sequence>> odd_sequences() {
  std::mt19937 random(5);
  std::vector<std::pair<std::string, Sequence>> odd;
  odd.emplace_back("noise", random_sequence(grid(4, 3), 7, random));
  odd.emplace_back("one frame", random_sequence(grid(4, 3), 1, random));
  Sequence still = random_sequence(grid(4, 3), 1, random);
  still.frames.resize(9, still.frames.front());
  odd.emplace_back("still", still);
  Sequence point = random_sequence(tetrahedron(), 5, random);
  for (FramePositions& frame : point.frames) std::fill(frame.begin(), frame.end(), 3.5f);
  odd.emplace_back("one place", point);
  Sequence rigid = still;
  for (std::size_t f = 0; f < rigid.frames.size(); ++f) {
    for (float& x : rigid.frames[f]) x += static_cast<float>(f);
  }
  odd.emplace_back("moved as one", rigid);
  Sequence lone{{1, {}}, {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}, {}};
  lone.mesh.faces = {{0, 0, 0}};
  odd.emplace_back("one vertex", lone);
  Sequence far = random_sequence(grid(4, 3), 6, random);
  for (FramePositions& frame : far.frames) {
    for (float& x : frame) x = x * 1e30f;
  }
  odd.emplace_back("far away", far);
  return odd;
}

TEST(ModeBasis, TakesSequencesWithLittleToFind) {
  for (const auto& [name, sequence] : odd_sequences()) {
    SCOPED_TRACE(name);
    const DecodedStream back = expect_whole(sequence, encode_sequence(sequence, basis_options(12, 4, 3)));
    const double step = std::ldexp(largest_extent(sequence), -12);
    EXPECT_LE(errors_of(sequence, back).rms, step / std::sqrt(12.0) * 1.001 + 1e-6);
  }
}

TEST(ModeBasis, CutsPeriodsIntoGops) {
  std::mt19937 random(3);
  const Sequence sequence = random_sequence(grid(5, 4), 11, random);
  const DecodedStream back = expect_whole(sequence, encode_sequence(sequence, basis_options(9, 7, 3)));
  std::vector<std::uint32_t> frames;
  std::size_t plans = 0;
  for (const IndexEntry& entry : back.index) {
    if (entry.kind == IndexEntry::Kind::kPlan) ++plans;
    if (entry.is_gop()) frames.push_back(entry.frame_count);
  }
  EXPECT_EQ(plans, 2u);
  EXPECT_EQ(frames, (std::vector<std::uint32_t>{3, 3, 1, 3, 1}));
}

TEST(ModeBasis, SaysWhatItCannotDo) {
  const Sequence sequence = corpus_sequence("hand");
  const auto refused = [&](const EncodeOptions& options) {
    SequenceSource source(sequence);
    const Result<Stream> stream = try_encode(source, options);
    EXPECT_FALSE(stream);
    return stream ? ErrorCode::kIo : stream.error().code;
  };
  EXPECT_EQ(refused(basis_options(17)), ErrorCode::kInvalidArgument);
  EncodeOptions options = basis_options(11);
  options.effort = 10;
  EXPECT_EQ(refused(options), ErrorCode::kInvalidArgument);
  options = basis_options(11);
  options.step = 1e-9;
  EXPECT_EQ(refused(options), ErrorCode::kInvalidArgument);
  options = basis_options(11);
  options.max_error = ErrorBound{-1, false};
  EXPECT_EQ(refused(options), ErrorCode::kInvalidArgument);
}

TEST(ModeBasis, TakesMoreMemoryForMorePeriodsOnlyAsFarAsTheHeadSays) {
  std::mt19937 random(8);
  const Sequence sequence = random_sequence(grid(12, 12), 40, random);
  const Stream stream = encode_sequence(sequence, basis_options(10, 4, 4));
  const DecodedStream back = expect_whole(sequence, stream);
  DecoderLimits limits;
  limits.memory = back.head.limits.decoder_memory;
  EXPECT_TRUE(decode_stream(stream, limits).complete);
  limits.memory -= 1;
  EXPECT_FALSE(decode_stream(stream, limits).complete);
}

}  // namespace
}  // namespace tvg::test
