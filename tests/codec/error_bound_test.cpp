#include "codec_toolbox.hpp"
#include "corpus/corpus.hpp"
#include "real_sequences.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace tvg::test {
namespace {

/// Every coordinate lies within half a step of its own lattice, but for rounding to float32.
void expect_within_half_a_step(const Sequence& sequence, int fine_bits, int coarse_bits) {
  EncodeOptions options;
  options.fine_bits = fine_bits;
  options.coarse_bits = coarse_bits;
  options.gop_frames = 8;
  const DecodedStream back = decode_stream(encode_sequence(sequence, options));
  ASSERT_TRUE(back.complete && back.damage.empty());
  ASSERT_EQ(back.frames.size(), sequence.frames.size());
  for (const DecodedFrame& frame : back.frames) {
    const FramePositions& original = sequence.frames[frame.number];
    for (std::size_t i = 0; i < original.size(); ++i) {
      const int shift = frame.flags[i / 3] != 0 ? 0 : fine_bits - coarse_bits;
      const double half = std::ldexp(frame.gop.step, shift) / 2;
      const double rounding = std::abs(double{frame.positions[i]}) * 0x1p-24 + half * 1e-9;
      ASSERT_LE(std::abs(double{frame.positions[i]} - double{original[i]}), half + rounding)
          << fine_bits << ':' << coarse_bits << " frame " << frame.number << " vertex " << i / 3;
    }
  }
}

TEST(ErrorBound, IsHalfAStepOnTheCorpusAt7To16Bits) {
  for (const corpus::CorpusEntry& entry : corpus::corpus_entries()) {
    SCOPED_TRACE(std::string(entry.name));
    const Sequence sequence = entry.make(*corpus::named_size("small")).sequence;
    for (int bits = 7; bits <= 16; ++bits) {
      ASSERT_NO_FATAL_FAILURE(expect_within_half_a_step(sequence, bits, bits));
      ASSERT_NO_FATAL_FAILURE(expect_within_half_a_step(sequence, bits, bits - 2));
    }
  }
}

TEST(ErrorBound, IsHalfAStepOnRealSequences) {
  const std::vector<RealSequence> sequences = real_sequences(20);
  if (sequences.empty()) GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  for (const auto& [name, sequence] : sequences) {
    SCOPED_TRACE(name);
    for (const auto& [fine, coarse] :
         {std::pair(7, 7), std::pair(11, 9), std::pair(13, 11), std::pair(16, 16)}) {
      ASSERT_NO_FATAL_FAILURE(expect_within_half_a_step(sequence, fine, coarse));
    }
  }
}

struct CoordinateErrors {
  double rms = 0;
  double largest = 0;
};

CoordinateErrors errors_after(const Sequence& sequence, const EncodeOptions& options) {
  const DecodedStream back = decode_stream(encode_sequence(sequence, options));
  EXPECT_TRUE(back.complete && back.damage.empty());
  EXPECT_EQ(back.frames.size(), sequence.frames.size());
  CoordinateErrors errors;
  double sum = 0, count = 0;
  for (const DecodedFrame& frame : back.frames) {
    const FramePositions& original = sequence.frames[frame.number];
    for (std::size_t i = 0; i < original.size(); ++i) {
      const double missed = std::abs(double{frame.positions[i]} - double{original[i]});
      sum += missed * missed;
      ++count;
      errors.largest = std::max(errors.largest, missed);
    }
  }
  errors.rms = std::sqrt(sum / std::max(count, 1.0));
  return errors;
}

TEST(ErrorBound, IsWhatWasAskedForOnRealSequencesInBothModes) {
  const std::vector<RealSequence> sequences = real_sequences(16);
  if (sequences.empty()) GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  for (const auto& [name, sequence] : sequences) {
    const double diagonal = box_around(sequence.frames).diagonal();
    for (const Mode mode : {Mode::kElp, Mode::kBasis}) {
      for (const double share : {0.002, 0.0002}) {
        SCOPED_TRACE(name + (mode == Mode::kBasis ? " basis " : " elp ") + std::to_string(share));
        EncodeOptions options;
        options.mode = mode;
        options.gop_frames = 8;
        options.max_error = ErrorBound{share, true};
        EXPECT_LE(errors_after(sequence, options).largest, share * diagonal);
      }
    }
  }
}

TEST(ErrorBound, OfABasisIsTheMeanErrorOfTheLatticeOnRealSequences) {
  const std::vector<RealSequence> sequences = real_sequences(16);
  if (sequences.empty()) GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  for (const auto& [name, sequence] : sequences) {
    for (const int bits : {9, 11, 13}) {
      SCOPED_TRACE(name + " " + std::to_string(bits));
      EncodeOptions options;
      options.gop_frames = 8;
      options.fine_bits = options.coarse_bits = bits;
      const double of_the_lattice = errors_after(sequence, options).rms;
      options.mode = Mode::kBasis;
      EXPECT_LE(errors_after(sequence, options).rms, 1.01 * of_the_lattice);
    }
  }
}

}  // namespace
}  // namespace tvg::test
