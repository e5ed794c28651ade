#include "planes/metered_decoder.hpp"

#include "plane_builders.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg::test {
namespace {

TEST(MeteredDecoder, GivesEachPlaneItsBitsAndDecodesTheSame) {
  std::mt19937 random(1);
  const Lattice lattice{{}, 1, 16, 16};
  const std::vector<Gate> gates = random_gates(400, random);
  std::vector<Frame> frames = random_frames(gates.size(), 6, lattice, {}, 3000, random);
  // The first plane stands still from the second frame on, the second one moves little, the third one much.
  for (std::size_t f = 1; f < frames.size(); ++f) {
    for (std::size_t v = 0; v < gates.size(); ++v) {
      frames[f][v][0] = frames[0][v][0];
      frames[f][v][1] = frames[0][v][1] ^ static_cast<std::int32_t>(random() % 4);
    }
  }
  const auto packets = encode_frames(gates, {}, lattice, Predictor::kTime, frames);
  PlaneCoder<3> coder(Schedule(gates), {}, lattice);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    MeteredDecoder<3> decoder(packets[f]);
    coder.next();
    ASSERT_TRUE(coder.code(decoder, predictor_at(f, Predictor::kTime)));
    ASSERT_TRUE(decoder.finished());
    ASSERT_TRUE(std::equal(frames[f].begin(), frames[f].end(), std::as_const(coder).indices().begin()));
    const std::array<double, 3> bits = decoder.bits();
    EXPECT_NEAR(bits[0] + bits[1] + bits[2], 8.0 * static_cast<double>(packets[f].size()), 18);
    if (f < 2) continue;
    EXPECT_LT(bits[0], 400);
    EXPECT_GT(bits[1], 400);
    EXPECT_LT(bits[1], 400 * 4);
    EXPECT_GT(bits[2], 400 * 8);
  }
}

}  // namespace
}  // namespace tvg::test
