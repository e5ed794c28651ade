#include "planes/residual_models.hpp"

#include "entropy/range_coder.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {
namespace {

struct Residual {
  ModelChoice choice;
  std::int32_t value;
};

ModelChoice random_choice(std::size_t sets, std::mt19937& random) {
  const auto below = [&random](std::uint32_t bound) { return static_cast<std::uint32_t>(random() % bound); };
  return {below(static_cast<std::uint32_t>(sets)), random() % 4 == 0 ? below(1u << 30) : below(300),
          below(15), below(15)};
}

/// Of every size up to 2^26, either sign.
std::int32_t random_residual(std::mt19937& random) {
  const auto size = static_cast<std::int32_t>(random() & ((1u << (random() % 27)) - 1));
  return random() % 2 == 0 ? size : -size;
}

TEST(ResidualModels, ResidualsOfEverySizeComeBackUnderEveryChoiceOfModels) {
  std::mt19937 random(1);
  for (const std::size_t sets : {std::size_t{1}, std::size_t{6}}) {
    std::vector<Residual> residuals;
    for (int i = 0; i < 20000; ++i)
      residuals.push_back({random_choice(sets, random), random_residual(random)});
    for (const std::int32_t edge : {0, 1, 6, 7, 8, 9, 14, 15, 1 << 26}) {
      residuals.push_back({random_choice(sets, random), edge});
      residuals.push_back({random_choice(sets, random), -edge});
    }
    RangeEncoder encoder;
    ResidualModels writer(sets);
    for (const Residual& r : residuals) ASSERT_EQ(writer.code(encoder, r.choice, r.value), r.value);
    const std::vector<std::uint8_t> bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    ResidualModels reader(sets);
    for (const Residual& r : residuals) ASSERT_EQ(reader.code(decoder, r.choice, 0), r.value);
    EXPECT_TRUE(decoder.finished());
  }
}

TEST(ResidualModels, SetsLearnIndependently) {
  const ModelChoice a{0, 0, 7, 7}, b{1, 0, 7, 7};
  ResidualModels models(2), fresh(2);
  RangeEncoder scratch, expected, given;
  for (int i = 0; i < 100; ++i) models.code(scratch, a, 3);
  for (int i = 0; i < 20; ++i) {
    models.code(given, b, 1);
    fresh.code(expected, b, 1);
  }
  EXPECT_EQ(given.finish(), expected.finish());
}

TEST(ResidualModels, RandomBytesYieldBoundedResiduals) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint8_t> bytes(200);
    for (std::uint8_t& byte : bytes) byte = round % 3 == 0 ? 0xFF : static_cast<std::uint8_t>(random());
    RangeDecoder decoder(bytes);
    ResidualModels models(1);
    for (int i = 0; i < 300; ++i) {
      const std::int32_t value = models.code(decoder, random_choice(1, random), 0);
      ASSERT_LE(std::abs(value), 1 << 27);
    }
  }
}

}  // namespace
}  // namespace tvg
