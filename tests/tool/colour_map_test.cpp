#include "tool/colour_map.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace tvg::cli {
namespace {

/// CIE 1976 lightness, 0 to 100.
double lightness(const Colour& colour) {
  const auto linear = [](double part) {
    return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(Viridis, GetsLighterEvenlyFromEndToEnd) {
  constexpr int kSteps = 200;
  const double first = lightness(map_colour(ColourMap::kViridis, 0));
  const double last = lightness(map_colour(ColourMap::kViridis, 1));
  EXPECT_LT(first, 20);
  EXPECT_GT(last, 88);
  const double even = (last - first) / kSteps;
  double before = first;
  for (int i = 1; i <= kSteps; ++i) {
    const double now = lightness(map_colour(ColourMap::kViridis, static_cast<double>(i) / kSteps));
    EXPECT_GT(now - before, 0.3 * even) << i;
    EXPECT_LT(now - before, 2.0 * even) << i;
    before = now;
  }
}

TEST(Flags, AreTwoColoursWithASharpBorder) {
  const Colour plain = map_colour(ColourMap::kFlags, 0);
  const Colour flagged = map_colour(ColourMap::kFlags, 1);
  EXPECT_EQ(map_colour(ColourMap::kFlags, 0.4).red, plain.red);
  EXPECT_EQ(map_colour(ColourMap::kFlags, 0.6).red, flagged.red);
  EXPECT_GT(flagged.red - flagged.blue, 0.5F);
  EXPECT_LT(std::abs(plain.red - plain.blue), 0.1F);
}

TEST(ColourMaps, TakeAnyValue) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const ColourMap map : {ColourMap::kViridis, ColourMap::kFlags}) {
    const Colour low = map_colour(map, 0);
    const Colour high = map_colour(map, 1);
    EXPECT_EQ(map_colour(map, kNan).green, low.green);
    EXPECT_EQ(map_colour(map, -1e30).green, low.green);
    EXPECT_EQ(map_colour(map, INFINITY).green, high.green);
  }
}

TEST(ColourScale, LeavesOutTheFewHighestAndWhatIsNotFinite) {
  std::vector<float> values;
  for (int i = 0; i < 1000; ++i) values.push_back(static_cast<float>(i));
  values.push_back(INFINITY);
  values.push_back(NAN);
  std::vector<float> scratch;
  EXPECT_EQ(value_at_share(values, 0.95, scratch), 950);
  EXPECT_EQ(value_at_share(values, 1.0, scratch), 999);
  EXPECT_EQ(value_at_share({}, 0.5, scratch), 0);
}

TEST(ColourScale, BringsValuesBetweenZeroAndOne) {
  std::vector<float> values = {0, 1, 4, 100};
  scale_values(values, {0, 4});
  EXPECT_EQ(values, (std::vector<float>{0, 0.25F, 1, 1}));
  scale_values(values, {0, 0});
  EXPECT_EQ(values, (std::vector<float>{0, 0, 0, 0}));
  values = {-3, -2, -1, 5};
  scale_values(values, {-2, 0});
  EXPECT_EQ(values, (std::vector<float>{0, 0, 0.5F, 1}));
}

}  // namespace
}  // namespace tvg::cli
