#include "planes/lanes.hpp"

#include "plane_trace.hpp"

#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <vector>

namespace tvg::test {

std::vector<std::int32_t> trace_plain_lanes(std::uint32_t seed);
std::vector<std::vector<std::uint8_t>> trace_plain_planes(std::uint32_t seed);

namespace {

TEST(Lanes, PlainFormGivesTheSameNumbers) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) EXPECT_EQ(trace_lanes(seed), trace_plain_lanes(seed));
}

TEST(Lanes, PlainFormGivesTheSamePackets) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) EXPECT_EQ(trace_planes(seed), trace_plain_planes(seed));
}

TEST(Lanes, FunctionsDoWhatTheirNamesSay) {
  for (const std::int32_t x : {-1000, -9, -8, -7, -3, -2, -1, 0, 1, 2, 3, 6, 7, 8, 1 << 27}) {
    const Lanes lanes = Lanes::all(x);
    EXPECT_EQ(abs(lanes)[3], std::abs(x));
    EXPECT_EQ(half(lanes)[0], x / 2);
    EXPECT_EQ(clamp<1>(lanes)[1], std::clamp(x, -1, 1));
    EXPECT_EQ(clamp<2>(lanes)[1], std::clamp(x, -2, 2));
    EXPECT_EQ(clamp<7>(lanes)[2], std::clamp(x, -7, 7));
    EXPECT_EQ((lanes > 2)[0], x > 2 ? -1 : 0);
    EXPECT_EQ((lanes < -2)[0], x < -2 ? -1 : 0);
    EXPECT_EQ((lanes | Lanes::all(6))[1], x | 6);
    EXPECT_EQ(any(lanes), x != 0);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      Quad one{};
      one[lane] = x;
      EXPECT_EQ(any(Lanes(one)), x != 0);
    }
  }
}

}  // namespace
}  // namespace tvg::test
