#include "entropy/adaptive_models.hpp"
#include "model_trace.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {

std::vector<std::uint32_t> trace_portable_models(std::uint32_t seed);

namespace {

std::uint32_t frequency(const AdaptiveSymbol& a, const AdaptiveSymbol& b, std::uint32_t symbol) {
  return SymbolMixture::cumulative(a, b, symbol + 1) - SymbolMixture::cumulative(a, b, symbol);
}

void expect_valid(const AdaptiveSymbol& a, const AdaptiveSymbol& b) {
  ASSERT_EQ(SymbolMixture::cumulative(a, b, 0), 0u);
  ASSERT_EQ(SymbolMixture::cumulative(a, b, AdaptiveSymbol::kMaxSymbols), 1u << 16);
  for (std::uint32_t s = 0; s < AdaptiveSymbol::kMaxSymbols; ++s) {
    ASSERT_GE(SymbolMixture::cumulative(a, b, s + 1), SymbolMixture::cumulative(a, b, s) + 8)
        << "symbol " << s;
  }
}

TEST(Models, FrequenciesStayPositiveAndAddUpToTheScaleWhateverTheModelsLearn) {
  std::mt19937 random(1);
  for (std::uint32_t run = 0; run < 200; ++run) {
    const std::uint32_t symbols = 2 + run % 15;
    AdaptiveSymbol a(static_cast<int>(symbols)), b;
    expect_valid(a, b);
    for (int step = 0; step < 400; ++step) {
      a.adapt(run % 3 == 0 ? symbols - 1 : static_cast<std::uint32_t>(random() % symbols));
      b.adapt(run % 2 == 0 ? 0 : static_cast<std::uint32_t>(random() % 16));
      ASSERT_NO_FATAL_FAILURE(expect_valid(a, b));
      ASSERT_NO_FATAL_FAILURE(expect_valid(a, a));
    }
  }
}

TEST(Models, EverySingleSymbolRepeatedForeverLeavesTheOthersCodable) {
  for (std::uint32_t symbol = 0; symbol < 16; ++symbol) {
    AdaptiveSymbol model;
    for (int step = 0; step < 5000; ++step) model.adapt(symbol);
    ASSERT_NO_FATAL_FAILURE(expect_valid(model, model));
    EXPECT_GT(frequency(model, model, symbol), 60000u) << "symbol " << symbol;
  }
}

TEST(Models, GivenWeightsBecomeFrequencies) {
  const AdaptiveSymbol model(std::array<std::uint16_t, 16>{0x4000, 0x8000, 0, 0x1FFF});
  ASSERT_NO_FATAL_FAILURE(expect_valid(model, model));
  EXPECT_NEAR(frequency(model, model, 0), 16384, 48);
  EXPECT_NEAR(frequency(model, model, 1), 32768, 96);
  EXPECT_EQ(frequency(model, model, 2), 8u);
  EXPECT_NEAR(frequency(model, model, 15), 8192, 96) << "what the weights leave goes to the last symbol";
}

TEST(Models, AnUnusedSymbolOfASmallAlphabetCostsTheLeastPossible) {
  const AdaptiveSymbol model(6);
  for (std::uint32_t s = 6; s < 16; ++s) EXPECT_EQ(frequency(model, model, s), 8u);
}

TEST(Models, LearnFastAtFirstAndMoreSlowlyLaterWhateverTheSymbols) {
  std::mt19937 random(2);
  for (int run = 0; run < 20; ++run) {
    AdaptiveSymbol model;
    for (int seen = 0; seen < 60; ++seen) {
      AdaptiveSymbol next = model;
      next.adapt(15);
      const double before = SymbolMixture::cumulative(model, model, 15);
      const double after = SymbolMixture::cumulative(next, next, 15);
      const int rate = seen < 2 ? 2 : seen < 6 ? 3 : seen < 16 ? 4 : seen < 32 ? 5 : 6;
      ASSERT_NEAR(after, before - (before - 120) / (1 << rate), 3) << seen;
      model.adapt(static_cast<std::uint32_t>(random() % 16));
    }
  }
}

TEST(Models, ThatHaveSeenSymbolsLearnOnFromThere) {
  const std::array<std::uint16_t, 16> weights = {0x1000, 0x2000, 0x3000, 0x4000};
  for (int seen = 0; seen < 40; ++seen) {
    AdaptiveSymbol model(weights, seen);
    const double before = SymbolMixture::cumulative(model, model, 4);
    model.adapt(15);
    const int rate = seen < 2 ? 2 : seen < 6 ? 3 : seen < 16 ? 4 : seen < 32 ? 5 : 6;
    EXPECT_NEAR(SymbolMixture::cumulative(model, model, 4), before - (before - 32) / (1 << rate), 3) << seen;
  }
}

TEST(Models, FindGivesTheIntervalThatHoldsTheCode) {
  AdaptiveSymbol a, b(5);
  for (std::uint32_t i = 0; i < 50; ++i) a.adapt(i % 7);
  for (const AdaptiveSymbol* second : {&a, &b}) {
    for (const std::uint32_t range : {1u << 15, (1u << 15) + 1, 50000u, (1u << 16) - 1}) {
      const SymbolMixture mixture(a, *second);
      for (std::uint32_t code = 0; code < range; ++code) {
        const SymbolMixture::Found found = mixture.find(range, code);
        ASSERT_LE(found.interval.low, code);
        ASSERT_GT(found.interval.high, code);
        const SymbolMixture::Interval written = SymbolMixture::interval_of(a, *second, found.symbol, range);
        ASSERT_EQ(found.interval.low, written.low);
        ASSERT_EQ(found.interval.high, written.high);
      }
    }
  }
}

TEST(Models, LearnTheSameFromASymbolFoundAsFromOneGiven) {
  std::mt19937 random(3);
  AdaptiveSymbol found_model, given_model, other(9);
  for (int step = 0; step < 3000; ++step) {
    const auto range = static_cast<std::uint32_t>((1u << 15) + random() % (1u << 15));
    const SymbolMixture::Found found =
        SymbolMixture(found_model, other).find(range, static_cast<std::uint32_t>(random() % range));
    found_model.adapt(found.goals);
    given_model.adapt(found.symbol);
    for (std::uint32_t s = 0; s <= 16; ++s) {
      ASSERT_EQ(SymbolMixture::cumulative(found_model, other, s),
                SymbolMixture::cumulative(given_model, other, s));
    }
  }
}

TEST(Models, MixtureDoesNotDependOnTheOrderOfItsModels) {
  AdaptiveSymbol a, b(3);
  for (std::uint32_t i = 0; i < 33; ++i) a.adapt(i * i % 11);
  for (std::uint32_t s = 0; s <= 16; ++s)
    EXPECT_EQ(SymbolMixture::cumulative(a, b, s), SymbolMixture::cumulative(b, a, s));
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
