#include "planes/cell_centres.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace tvg {
namespace {

std::array<std::uint32_t, 3> bits_of(const std::array<float, 3>& position) {
  std::array<std::uint32_t, 3> bits{};
  std::memcpy(bits.data(), position.data(), sizeof bits);
  return bits;
}

TEST(CellCentres, AreThoseOfEachAxisBitForBit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-60, 40), start(-1, 1);
  for (int round = 0; round < 300; ++round) {
    const double step =
        std::exp2(exponent(random)) * (round % 2 == 0 ? 1 : start(random) * start(random) + 1.5);
    const std::array<double, 3> origin = {start(random) * 1e3, start(random) * 1e-9,
                                          round % 3 == 0 ? 0 : 7e20};
    const CellCentres centres(origin, step, 24);
    for (int i = 0; i < 100; ++i) {
      const auto index = [&] { return static_cast<std::int32_t>(random() % (1u << (1 + random() % 24))); };
      const Quad indices = {index(), index(), index(), 0};
      std::array<float, 3> position{}, expected{};
      centres.put(indices, reinterpret_cast<std::byte*>(position.data()));
      for (std::size_t axis = 0; axis < 3; ++axis)
        expected[axis] = reconstruct(indices[axis], origin[axis], step);
      ASSERT_EQ(bits_of(position), bits_of(expected));
    }
  }
}

TEST(CellCentres, BeyondTheLargestFloatStayThere) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  std::array<float, 3> position{};
  CellCentres({-1e300, 1e300, 3e38}, 1e38, 4)
      .put({0, 15, 15, 0}, reinterpret_cast<std::byte*>(position.data()));
  EXPECT_EQ(position, (std::array<float, 3>{-kLargest, kLargest, kLargest}));
}

TEST(CellCentres, TouchTwelveBytesThatNeedNotBeAligned) {
  std::array<std::byte, 16> bytes{};
  bytes.fill(std::byte{0x5A});
  CellCentres({0, 0, 0}, 2, 8).put({1, 2, 3, 0}, bytes.data() + 1);
  std::array<float, 3> position{};
  std::memcpy(position.data(), bytes.data() + 1, sizeof position);
  EXPECT_EQ(position, (std::array<float, 3>{3, 5, 7}));
  EXPECT_EQ(bytes[0], std::byte{0x5A});
  for (std::size_t i = 13; i < 16; ++i) EXPECT_EQ(bytes[i], std::byte{0x5A});
}

}  // namespace
}  // namespace tvg
