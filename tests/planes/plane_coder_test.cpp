#include "planes/plane_coder.hpp"

#include "plane_builders.hpp"

#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

namespace tvg::test {
namespace {

/// Decodes the packets and compares every index.
template <std::size_t kPlanes = 3>
void expect_frames_back(const std::vector<Gate>& gates, const std::vector<std::uint8_t>& flags,
                        const Lattice& lattice, Predictor predictor, const std::vector<Frame>& frames) {
  const std::vector<std::vector<std::uint8_t>> packets =
      encode_frames<kPlanes>(gates, flags, lattice, predictor, frames);
  PlaneCoder<kPlanes> back(Schedule(gates), flags, lattice);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    back.next();
    TwoEndedDecoder decoder(packets[f]);
    ASSERT_TRUE(back.code(decoder, predictor_at(f, predictor))) << "frame " << f;
    ASSERT_TRUE(decoder.finished()) << "frame " << f;
    const std::span<const Quad> indices = back.indices();
    ASSERT_TRUE(std::equal(indices.begin(), indices.end(), frames[f].begin())) << "frame " << f;
  }
}

template <std::size_t kPlanes>
void expect_group_back() {
  std::mt19937 random(7);
  for (const int coarse : {11, 8, 2}) {
    const Lattice lattice{{}, 1, 11, coarse};
    for (const Predictor predictor : kPredictors) {
      const std::vector<Gate> gates = random_gates(150, random);
      const std::vector<std::uint8_t> flags =
          lattice.hybrid() ? random_flags(gates.size(), 0.4, random) : std::vector<std::uint8_t>();
      const std::vector<Frame> frames = random_frames<kPlanes>(gates.size(), 4, lattice, flags, 20, random);
      ASSERT_NO_FATAL_FAILURE(expect_frames_back<kPlanes>(gates, flags, lattice, predictor, frames))
          << kPlanes << " planes, " << coarse << " coarse bits";
    }
  }
}

TEST(PlaneCoder, GroupsOfOneToFourPlanesComeBack) {
  expect_group_back<1>();
  expect_group_back<2>();
  expect_group_back<3>();
  expect_group_back<4>();
}

TEST(PlaneCoder, PredictorsMayChangeFromFrameToFrame) {
  std::mt19937 random(8);
  const Lattice lattice{{}, 1, 12, 9};
  const std::vector<Gate> gates = random_gates(200, random);
  const std::vector<std::uint8_t> flags = random_flags(gates.size(), 0.3, random);
  const std::vector<Frame> frames = random_frames(gates.size(), 12, lattice, flags, 9, random);
  PlaneCoder<3> writer(Schedule(gates), flags, lattice), reader(Schedule(gates), flags, lattice);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Predictor predictor = predictor_at(f, kPredictors[(f * f + f / 3) % 3]);
    writer.next();
    std::copy(frames[f].begin(), frames[f].end(), writer.indices().begin());
    TwoEndedEncoder encoder;
    writer.code(encoder, predictor);
    const std::vector<std::uint8_t> packet = encoder.finish();
    TwoEndedDecoder decoder(packet);
    reader.next();
    ASSERT_TRUE(reader.code(decoder, predictor)) << "frame " << f;
    ASSERT_TRUE(decoder.finished());
    ASSERT_TRUE(std::equal(frames[f].begin(), frames[f].end(), std::as_const(reader).indices().begin()));
  }
}

TEST(PlaneCoder, FramesComeBackAtEveryNumberOfBitsWithEveryPredictor) {
  std::mt19937 random(1);
  for (int bits = kMinBits; bits <= kMaxBits; ++bits) {
    const Lattice lattice{{}, 1, bits, bits};
    for (const Predictor predictor : kPredictors) {
      for (const std::int32_t move : {0, 1, 3, 1 << (bits - 1), (1 << bits) - 1}) {
        const std::vector<Gate> gates = random_gates(120, random);
        const std::vector<Frame> frames = random_frames(gates.size(), 4, lattice, {}, move, random);
        ASSERT_NO_FATAL_FAILURE(expect_frames_back(gates, {}, lattice, predictor, frames))
            << bits << " bits, moves of " << move;
      }
    }
  }
}

TEST(PlaneCoder, HybridFramesComeBackForEveryPairOfBits) {
  std::mt19937 random(2);
  for (int fine = 2; fine <= kMaxBits; ++fine) {
    for (int coarse = 1; coarse < fine; coarse += 1 + fine / 8) {
      const Lattice lattice{{}, 1, fine, coarse};
      for (const Predictor predictor : kPredictors) {
        const std::vector<Gate> gates = random_gates(100, random);
        const std::vector<std::uint8_t> flags =
            random_flags(gates.size(), static_cast<double>(coarse % 5) / 4, random);
        const std::int32_t move = coarse % 2 == 0 ? 2 : (1 << fine) - 1;
        const std::vector<Frame> frames = random_frames(gates.size(), 3, lattice, flags, move, random);
        ASSERT_NO_FATAL_FAILURE(expect_frames_back(gates, flags, lattice, predictor, frames))
            << fine << ':' << coarse;
      }
    }
  }
}

TEST(PlaneCoder, JumpsAcrossTheWholeLatticeComeBackAt24Bits) {
  std::mt19937 random(3);
  const std::int32_t last = (1 << 24) - 1;
  const std::vector<Gate> gates = random_gates(200, random);
  const std::vector<std::uint8_t> flags = random_flags(gates.size(), 0.5, random);
  for (const bool hybrid : {false, true}) {
    const Lattice lattice{{}, 1, 24, hybrid ? 3 : 24};
    const std::vector<std::uint8_t> used = hybrid ? flags : std::vector<std::uint8_t>();
    std::vector<Frame> frames(6, Frame(gates.size(), Quad{}));
    for (Frame& frame : frames) {
      for (std::size_t v = 0; v < frame.size(); ++v) {
        const int shift = used.empty() || used[v] != 0 ? 0 : lattice.shift();
        for (std::size_t axis = 0; axis < 3; ++axis) {
          frame[v][axis] = pad_to_fine(shift_to_coarse(random() % 2 == 0 ? 0 : last, shift), shift);
        }
      }
    }
    for (const Predictor predictor : kPredictors) {
      ASSERT_NO_FATAL_FAILURE(expect_frames_back(gates, used, lattice, predictor, frames));
    }
  }
}

TEST(PlaneCoder, HybridLatticeWithAllFlagsSetGivesTheBytesOfTheUniformOne) {
  std::mt19937 random(4);
  for (const int bits : {2, 5, 11, 17, 24}) {
    const Lattice uniform{{}, 1, bits, bits};
    for (const int coarse : {1, bits - 1}) {
      const Lattice hybrid{{}, 1, bits, coarse};
      for (const Predictor predictor : kPredictors) {
        for (const std::int32_t move : {0, 1, 2, 5, 20, (1 << bits) - 1}) {
          const std::vector<Gate> gates = random_gates(150, random);
          const std::vector<std::uint8_t> flags(gates.size(), 1);
          const std::vector<Frame> frames = random_frames(gates.size(), 4, uniform, {}, move, random);
          ASSERT_EQ(encode_frames(gates, flags, hybrid, predictor, frames),
                    encode_frames(gates, {}, uniform, predictor, frames))
              << bits << ':' << coarse << " moves of " << move;
        }
      }
    }
  }
}

TEST(PlaneCoder, ElpCodesATranslationInNextToNothing) {
  std::mt19937 random(5);
  const Lattice lattice{{}, 1, 12, 12};
  std::vector<Gate> gates(2000);
  for (std::uint32_t v = 3; v < gates.size(); ++v) gates[v] = {v - 1, v - 2, v - 3};
  std::vector<Frame> frames = random_frames(gates.size(), 1, {{}, 1, 11, 11}, {}, 0, random);
  for (int f = 1; f < 4; ++f) {
    frames.push_back(frames.back());
    for (Quad& index : frames.back()) index = {index[0] + 100, index[1] + 31, index[2] + 7, 0};
  }
  const auto packets = encode_frames(gates, {}, lattice, Predictor::kElp, frames);
  EXPECT_GT(packets[0].size(), 5000u);
  EXPECT_LT(packets[3].size(), 100u);
}

TEST(PlaneCoder, DamagedPacketsLeaveEveryIndexOnItsLattice) {
  std::mt19937 random(6);
  for (int round = 0; round < 150; ++round) {
    const int fine = 1 + static_cast<int>(random() % 24);
    const Lattice lattice{{}, 1, fine, 1 + static_cast<int>(random() % static_cast<unsigned>(fine))};
    const std::vector<Gate> gates = random_gates(80, random);
    const std::vector<std::uint8_t> flags =
        lattice.hybrid() ? random_flags(gates.size(), 0.4, random) : std::vector<std::uint8_t>();
    PlaneCoder<3> coder(Schedule(gates), flags, lattice);
    for (int frame = 0; frame < 4; ++frame) {
      std::vector<std::uint8_t> bytes(random() % 400);
      for (std::uint8_t& byte : bytes) byte = round % 4 == 0 ? 0xFF : static_cast<std::uint8_t>(random());
      TwoEndedDecoder decoder(bytes);
      coder.next();
      coder.code(decoder, frame == 0 ? Predictor::kSpace : kPredictors[random() % 3]);
      for (const Quad& index : std::as_const(coder).indices()) {
        for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(index[axis] >> fine, 0);
        ASSERT_EQ(index[3], 0);
      }
    }
  }
}

TEST(PlaneCoder, WorkOnAnEmptyPacketEndsSoon) {
  const std::vector<Gate> gates(1000000);
  PlaneCoder<3> coder(Schedule(gates), {}, {{}, 1, 11, 11});
  coder.next();
  TwoEndedDecoder decoder({});
  EXPECT_FALSE(coder.code(decoder, Predictor::kSpace));
  EXPECT_TRUE(decoder.overrun());
}

}  // namespace
}  // namespace tvg::test
