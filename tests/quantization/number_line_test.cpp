#include "quantization/number_line.hpp"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace tvg::test {
namespace {

constexpr float kInteresting[] = {0.0F, 0x1p-149F, 0x1.FFFFFCp-127F, 0x1p-126F,      1e-20F, 0.1F,
                                  1,    1.5F,      16777216,         0x1.FFFFFEp127F};

std::uint32_t bits(float x) {
  return std::bit_cast<std::uint32_t>(x);
}

TEST(NumberLine, OrderedIntegersKeepTheOrderOfNumbersAndBothZeros) {
  std::int32_t last = ordered(bits(-0x1.FFFFFEp127F)) - 1;
  for (std::size_t i = std::size(kInteresting); i-- > 0;) {
    EXPECT_GT(ordered(bits(-kInteresting[i])), last);
    last = ordered(bits(-kInteresting[i]));
  }
  EXPECT_EQ(last, -1);
  for (const float x : kInteresting) {
    EXPECT_GT(ordered(bits(x)), last);
    last = ordered(bits(x));
  }
}

TEST(NumberLine, ValuesOfFloatsAreThoseOfTheProcessor) {
  std::mt19937 random(1);
  for (int i = 0; i < 100000; ++i) {
    const auto any = static_cast<std::uint32_t>(random());
    const auto x = std::bit_cast<float>(any);
    if (!std::isfinite(x)) continue;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value_of_float(any)), std::bit_cast<std::uint64_t>(double{x}))
        << x;
    ASSERT_EQ(float_of_value(double{x}), any) << x;
  }
}

TEST(NumberLine, FloatsHaveConsecutivePlaces) {
  const NumberLine line = NumberLine::of_floats(0);
  for (const float x : kInteresting) {
    for (const float signed_x : {x, -x}) {
      const std::int32_t place = line.place_of(signed_x);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(line.value_at(place)),
                std::bit_cast<std::uint64_t>(double{signed_x}));
      if (x > 0) {
        EXPECT_EQ(line.place_between(signed_x), 64 * std::int64_t{place}) << signed_x;
      }
      EXPECT_EQ(line.place_of(std::nextafter(x, 0.0F)), x > 0 ? line.place_of(x) - 1 : 0);
    }
  }
  EXPECT_EQ(line.most(), line.place_of(0x1.FFFFFEp127F));
}

TEST(NumberLine, RealNumbersLieBetweenPlaces) {
  const NumberLine floats = NumberLine::of_floats(0);
  EXPECT_EQ(floats.place_between(1 + 0x1p-24), 64 * std::int64_t{floats.place_of(1)} + 32);
  EXPECT_EQ(floats.place_between(-1 - 0x1p-24), 64 * std::int64_t{floats.place_of(-1)} - 32);
  EXPECT_EQ(floats.place_between(0x1p-150), 32);
  EXPECT_EQ(floats.place_between(1e60), 64 * std::int64_t{floats.most()});
  const NumberLine eighths = NumberLine::of_multiples(-3);
  EXPECT_EQ(eighths.place_of(2.5), 20);
  EXPECT_EQ(eighths.place_of(-2.5), -21);
  EXPECT_EQ(eighths.place_of(-0.0), -1);
  EXPECT_EQ(eighths.value_at(-21), -2.5);
  EXPECT_EQ(eighths.place_between(2.5625), 20 * 64 + 32);
  EXPECT_EQ(eighths.place_between(-1e60), -64 - (std::int64_t{1} << 30));
}

TEST(NumberLine, LogarithmsOfSizesHaveNoSign) {
  EXPECT_EQ(log_sixteenths(-0.0), 0);
  EXPECT_EQ(log_sixteenths(-8), log_sixteenths(8));
  EXPECT_EQ(log_sixteenths(8) - log_sixteenths(4), 16);
}

TEST(NumberLine, StepsAreAsWideAsTheNumbersAreApart) {
  EXPECT_EQ(NumberLine::of_floats(0).log_step(1.75), log_sixteenths(0x1p-23));
  EXPECT_EQ(NumberLine::of_floats(13).log_step(-4), log_sixteenths(0x1p-8));
  EXPECT_EQ(NumberLine::of_floats(0).log_step(1e-44), log_sixteenths(0x1p-149));
  EXPECT_EQ(NumberLine::of_multiples(-7).log_step(1e9), log_sixteenths(0x1p-7));
}

}  // namespace
}  // namespace tvg::test
