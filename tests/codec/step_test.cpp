#include "codec_toolbox.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <string>

// A lattice given by its step: one grid for all GOPs, and a source that is read once.
namespace tvg::test {
namespace {

/// Counts what is asked of a sequence; one that cannot be rewound stands for a pipe.
class CountingSource final : public SourceDecorator {
 public:
  CountingSource(const Sequence& sequence, bool rewinds)
      : SourceDecorator(std::make_unique<SequenceSource>(sequence)), rewinds_(rewinds) {}

  Result<bool> read_frame(std::span<float> positions) override {
    ++reads;
    return SourceDecorator::read_frame(positions);
  }
  bool rewind() override {
    ++rewound;
    return rewinds_ && SourceDecorator::rewind();
  }

  std::size_t reads = 0, rewound = 0;

 private:
  bool rewinds_;
};

/// Frames that wander away from the origin, across it and back, so that each GOP has a box of its own.
Sequence wandering(std::size_t frames) {
  std::mt19937 random(7);
  Sequence sequence = random_sequence(grid(6, 5), frames, random);
  for (std::size_t f = 0; f < frames; ++f) {
    for (float& x : sequence.frames[f]) x += 40 * std::sin(static_cast<float>(f));
  }
  return sequence;
}

EncodeOptions step_options(double step, int coarser) {
  EncodeOptions options;
  options.step = step;
  options.fine_bits = 20;
  options.coarse_bits = 20 - coarser;
  options.gop_frames = 3;
  return options;
}

TEST(Step, ReadsTheSourceOnceAndNeverRewindsIt) {
  const Sequence sequence = wandering(8);
  CountingSource source(sequence, true);
  ASSERT_TRUE(try_encode(source, step_options(0.25, 0)));
  EXPECT_EQ(source.reads, 9u) << "each frame, and the end";
  EXPECT_EQ(source.rewound, 0u);
}

TEST(Step, SourcesThatCanAndThatCannotBeRewoundGiveTheSameBytes) {
  const Sequence sequence = wandering(8);
  for (const int coarser : {0, 3}) {
    CountingSource file(sequence, true), pipe(sequence, false);
    const Result<Stream> of_file = try_encode(file, step_options(0.01, coarser));
    const Result<Stream> of_pipe = try_encode(pipe, step_options(0.01, coarser));
    ASSERT_TRUE(of_file && of_pipe);
    EXPECT_EQ(*of_file, *of_pipe);
  }
}

TEST(Step, EveryCellOfEveryGopLiesOnOneGrid) {
  const Sequence sequence = wandering(11);
  for (const double step : {0.25, 0.01, 1.0 / 3, 7.0}) {
    for (const int coarser : {0, 2}) {
      SCOPED_TRACE(std::to_string(step) + ", " + std::to_string(coarser));
      const DecodedStream back = decode_stream(encode_sequence(sequence, step_options(step, coarser)));
      ASSERT_TRUE(back.complete && back.damage.empty());
      ASSERT_EQ(back.frames.size(), sequence.frames.size());
      for (const DecodedFrame& frame : back.frames) {
        ASSERT_EQ(frame.gop.step, step);
        for (std::size_t i = 0; i < frame.lattice.size(); ++i) {
          const int shift = frame.flags[i / 3] != 0 ? 0 : coarser;
          const double edge = std::ldexp(step, shift);
          const double first = frame.gop.origin[i % 3] / edge;
          ASSERT_NEAR(first, std::round(first), 1e-9) << "cells begin at multiples of their edge";
          const double x = sequence.frames[frame.number][i] / edge;
          ASSERT_NEAR(std::round(first) + frame.lattice[i] + 0.5, x, 0.5 + 1e-9);
        }
      }
    }
  }
}

TEST(Step, GopsHaveAsFewBitsAsTheirBoxesNeed) {
  const Sequence sequence = wandering(9);
  for (const int coarser : {0, 2}) {
    const DecodedStream back = decode_stream(encode_sequence(sequence, step_options(0.25, coarser)));
    for (std::size_t first = 0; first < 9; first += 3) {
      std::int32_t last = 0;
      for (std::size_t f = first; f < first + 3; ++f) {
        for (std::size_t i = 0; i < back.frames[f].lattice.size(); ++i) {
          const int shift = back.frames[f].flags[i / 3] != 0 ? 0 : coarser;
          last = std::max(last, ((back.frames[f].lattice[i] + 1) << shift) - 1);
        }
      }
      const int bits = back.frames[first].gop.fine_bits;
      EXPECT_LT(last, 1 << bits);
      EXPECT_GE(last, 1 << (bits - 1));
      EXPECT_EQ(bits - back.frames[first].gop.coarse_bits, coarser);
    }
  }
}

TEST(Step, PartsEncodedApartDecodeToThePositionsOfTheWhole) {
  const Sequence whole = wandering(9);
  const EncodeOptions options = step_options(1.0 / 64, 2);
  const DecodedStream together = decode_stream(encode_sequence(whole, options));
  for (std::size_t first = 0; first < 9; first += 3) {
    Sequence part{whole.mesh, {}, {}};
    for (std::size_t f = first; f < first + 3; ++f) part.frames.push_back(whole.frames[f]);
    const DecodedStream alone = decode_stream(encode_sequence(part, options));
    ASSERT_EQ(alone.frames.size(), 3u);
    for (std::size_t f = 0; f < 3; ++f)
      ASSERT_EQ(alone.frames[f].positions, together.frames[first + f].positions);
  }
  // Cut elsewhere, the same frames fall into the same cells: only the marks may differ, and here are none.
  EncodeOptions uniform = step_options(1.0 / 64, 0);
  const DecodedStream by_three = decode_stream(encode_sequence(whole, uniform));
  uniform.gop_frames = 4;
  const DecodedStream by_four = decode_stream(encode_sequence(whole, uniform));
  for (std::size_t f = 0; f < 9; ++f) ASSERT_EQ(by_three.frames[f].positions, by_four.frames[f].positions);
}

TEST(Step, NoCoordinateIsOffByMoreThanHalfAStepOfItsLattice) {
  const Sequence sequence = wandering(10);
  for (const double step : {0.01, 1e-4, 3.0, 1000.0}) {
    for (const int coarser : {0, 1, 5}) {
      const DecodedStream back = decode_stream(encode_sequence(sequence, step_options(step, coarser)));
      ASSERT_EQ(back.frames.size(), sequence.frames.size());
      for (const DecodedFrame& frame : back.frames) {
        for (std::size_t i = 0; i < frame.positions.size(); ++i) {
          const double half = std::ldexp(step, frame.flags[i / 3] != 0 ? 0 : coarser) / 2;
          const double rounding = std::abs(double{frame.positions[i]}) * 0x1p-24 + half * 1e-9;
          ASSERT_LE(std::abs(double{frame.positions[i]} - double{sequence.frames[frame.number][i]}),
                    half + rounding)
              << step;
        }
      }
    }
  }
}

TEST(Step, OneTooSmallIsRefusedAtTheFrameThatNeedsALargerOneAndTheErrorNamesIt) {
  const Sequence sequence = wandering(9);
  FramePositions far = sequence.frames[4];
  far[0] = 1e6F;
  Stream stream;
  Encoder encoder(step_options(0.01, 2), [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  ASSERT_TRUE(encoder.set_mesh(sequence.mesh).ok());
  for (std::size_t f = 0; f < 4; ++f) ASSERT_TRUE(encoder.add_frame(sequence.frames[f]).ok());
  const Status refused = encoder.add_frame(far);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().frame, 4u);
  EXPECT_NE(refused.error().message.find("27 bits"), std::string::npos) << refused.error().message;
  // Nothing has changed: frames that fit may follow, and another GOP may be far away.
  for (std::size_t f = 4; f < 6; ++f) ASSERT_TRUE(encoder.add_frame(sequence.frames[f]).ok());
  for (float& x : far) x += 1e6F;
  far[0] = 1e6F;
  ASSERT_TRUE(encoder.add_frame(far).ok());
  ASSERT_TRUE(encoder.finish());
  EXPECT_EQ(decode_stream(stream).frames.size(), 7u);
}

TEST(Step, TheStepThatAnErrorNamesWouldDo) {
  const Sequence sequence = wandering(2);
  for (const int coarser : {0, 7, 19}) {
    SequenceSource source(sequence);
    const Result<Stream> refused = try_encode(source, step_options(1e-7, coarser));
    ASSERT_FALSE(refused);
    const std::string& message = refused.error().message;
    const std::size_t at = message.find("at least ");
    ASSERT_NE(at, std::string::npos) << message;
    // It is that of the frames up to the error's; the second frame may need more.
    Sequence first{sequence.mesh, {sequence.frames[0]}, {}};
    EXPECT_EQ(refused.error().frame, 0u);
    EXPECT_FALSE(encode_sequence(first, step_options(std::stod(message.substr(at + 9)), coarser)).empty());
  }
}

TEST(Step, WithABoxEveryGopHasOneLattice) {
  const Sequence sequence = wandering(9);
  EncodeOptions options = step_options(0.25, 1);
  options.box = box_around(sequence.frames);
  const DecodedStream back = decode_stream(encode_sequence(sequence, options));
  ASSERT_EQ(back.frames.size(), 9u);
  for (const DecodedFrame& frame : back.frames) {
    EXPECT_EQ(frame.gop.origin, back.frames[0].gop.origin);
    EXPECT_EQ(frame.gop.fine_bits, back.frames[0].gop.fine_bits);
  }
  options.step = 1e-7;
  SequenceSource source(sequence);
  const Result<Stream> refused = try_encode(source, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace tvg::test
