#include "entropy/adaptive_models.hpp"
#include "model_trace.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {

std::vector<std::uint32_t> trace_portable_models(std::uint32_t seed);

namespace {

void expect_valid(const SymbolMixture& mixture) {
  ASSERT_EQ(mixture.cumulative(0), 0u);
  ASSERT_EQ(mixture.cumulative(AdaptiveSymbol::kMaxSymbols), 1u << 15);
  for (std::uint32_t s = 0; s < AdaptiveSymbol::kMaxSymbols; ++s) {
    ASSERT_GE(mixture.cumulative(s + 1), mixture.cumulative(s) + 4) << "symbol " << s;
  }
}

TEST(Models, FrequenciesStayPositiveAndAddUpToTheScaleWhateverTheModelsLearn) {
  std::mt19937 random(1);
  for (std::uint32_t run = 0; run < 200; ++run) {
    const std::uint32_t symbols = 2 + run % 15;
    AdaptiveSymbol a(static_cast<int>(symbols)), b;
    expect_valid(SymbolMixture(a, b));
    for (int step = 0; step < 400; ++step) {
      a.adapt(run % 3 == 0 ? symbols - 1 : static_cast<std::uint32_t>(random() % symbols));
      b.adapt(run % 2 == 0 ? 0 : static_cast<std::uint32_t>(random() % 16));
      ASSERT_NO_FATAL_FAILURE(expect_valid(SymbolMixture(a, b)));
      ASSERT_NO_FATAL_FAILURE(expect_valid(SymbolMixture(a, a)));
    }
  }
}

TEST(Models, EverySingleSymbolRepeatedForeverLeavesTheOthersCodable) {
  for (std::uint32_t symbol = 0; symbol < 16; ++symbol) {
    AdaptiveSymbol model;
    for (int step = 0; step < 5000; ++step) model.adapt(symbol);
    const SymbolMixture mixture(model, model);
    ASSERT_NO_FATAL_FAILURE(expect_valid(mixture));
    EXPECT_GT(mixture.cumulative(symbol + 1) - mixture.cumulative(symbol), 30000u) << "symbol " << symbol;
  }
}

TEST(Models, GivenWeightsBecomeFrequencies) {
  const AdaptiveSymbol model(std::array<std::uint16_t, 16>{0x4000, 0x8000, 0, 0x1FFF});
  const SymbolMixture mixture(model, model);
  ASSERT_NO_FATAL_FAILURE(expect_valid(mixture));
  const auto frequency = [&](std::uint32_t s) { return mixture.cumulative(s + 1) - mixture.cumulative(s); };
  EXPECT_NEAR(frequency(0), 8192, 24);
  EXPECT_NEAR(frequency(1), 16384, 48);
  EXPECT_EQ(frequency(2), 4u);
  EXPECT_NEAR(frequency(15), 4096, 48) << "what the weights leave goes to the last symbol";
}

TEST(Models, AnUnusedSymbolOfASmallAlphabetCostsTheLeastPossible) {
  const AdaptiveSymbol model(6);
  const SymbolMixture mixture(model, model);
  for (std::uint32_t s = 6; s < 16; ++s) EXPECT_EQ(mixture.cumulative(s + 1) - mixture.cumulative(s), 4u);
}

TEST(Models, FindGivesTheIntervalThatHoldsTheTarget) {
  AdaptiveSymbol a, b(5);
  for (std::uint32_t i = 0; i < 50; ++i) a.adapt(i % 7);
  for (const SymbolMixture& mixture : {SymbolMixture(a, a), SymbolMixture(a, b)}) {
    for (std::uint32_t target = 0; target < 1u << 15; ++target) {
      const SymbolMixture::Interval found = mixture.find(target);
      ASSERT_LE(found.low, target);
      ASSERT_GT(found.high, target);
      ASSERT_EQ(found.low, mixture.cumulative(found.symbol));
      ASSERT_EQ(found.high, mixture.cumulative(found.symbol + 1));
    }
  }
}

TEST(Models, MixtureDoesNotDependOnTheOrderOfItsModels) {
  AdaptiveSymbol a, b(3);
  for (std::uint32_t i = 0; i < 33; ++i) a.adapt(i * i % 11);
  const SymbolMixture ab(a, b), ba(b, a);
  for (std::uint32_t s = 0; s <= 16; ++s) EXPECT_EQ(ab.cumulative(s), ba.cumulative(s));
}

TEST(Models, BitFrequencyStaysWithinItsBounds) {
  for (const bool bit : {false, true}) {
    AdaptiveBit model;
    EXPECT_NEAR(model.zero_frequency(), 1u << 14, 64);
    for (int step = 0; step < 5000; ++step) {
      model.adapt(bit);
      ASSERT_GE(model.zero_frequency(), 32u);
      ASSERT_LE(model.zero_frequency(), 32736u);
    }
    // After so many of one kind the other is rare.
    EXPECT_TRUE(bit ? model.zero_frequency() < 400 : model.zero_frequency() > 32368)
        << model.zero_frequency();
  }
}

TEST(Models, BranchWithoutSse2GivesTheSameNumbers) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    ASSERT_EQ(trace_models(seed), trace_portable_models(seed)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace tvg
