#include "planes/residual_models.hpp"

#include "entropy/two_ended_coder.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {
namespace {

constexpr std::size_t kPlanes = 3;

/// The residuals of a vertex.
struct Residuals {
  GroupChoice choice;
  Quad values;
};

GroupChoice random_choice(std::size_t sets, std::mt19937& random) {
  const auto below = [&random](std::uint32_t bound) { return static_cast<std::int32_t>(random() % bound); };
  const auto activity = [&] { return random() % 4 == 0 ? below(1u << 30) : below(300); };
  const auto context = [&] { return Lanes(below(15), below(15), below(15), 0); };
  return {random() % sets, Lanes(activity(), activity(), activity(), 0), context(), context()};
}

/// Of every size up to 2^26, either sign.
std::int32_t random_residual(std::mt19937& random) {
  const auto size = static_cast<std::int32_t>(random() & ((1u << (random() % 27)) - 1));
  return random() % 2 == 0 ? size : -size;
}

Quad code(ResidualModels& models, TwoEndedEncoder& coder, const GroupChoice& choice, const Quad& values) {
  return models.code<kPlanes>(coder, choice, Lanes(values)).quad();
}
Quad code(ResidualModels& models, TwoEndedDecoder& coder, const GroupChoice& choice) {
  return models.code<kPlanes>(coder, choice, Lanes()).quad();
}

TEST(ResidualModels, ResidualsOfEverySizeComeBackUnderEveryChoiceOfModels) {
  std::mt19937 random(1);
  for (const std::size_t sets : {std::size_t{1}, std::size_t{6}}) {
    std::vector<Residuals> vertices;
    for (int i = 0; i < 8000; ++i) {
      vertices.push_back({random_choice(sets, random),
                          {random_residual(random), random_residual(random), random_residual(random), 0}});
    }
    for (const std::int32_t edge : {0, 1, 6, 7, 8, 9, 14, 15, 1 << 26}) {
      vertices.push_back({random_choice(sets, random), {edge, -edge, edge, 0}});
      vertices.push_back({random_choice(sets, random), {-edge, 0, -edge, 0}});
    }
    TwoEndedEncoder encoder;
    ResidualModels writer(sets);
    for (const Residuals& r : vertices) ASSERT_EQ(code(writer, encoder, r.choice, r.values), r.values);
    const std::vector<std::uint8_t> bytes = encoder.finish();
    TwoEndedDecoder decoder(bytes);
    ResidualModels reader(sets);
    for (const Residuals& r : vertices) ASSERT_EQ(code(reader, decoder, r.choice), r.values);
    EXPECT_TRUE(decoder.finished());
  }
}

TEST(ResidualModels, SetsLearnIndependently) {
  const GroupChoice a{0, {}, Lanes::all(7), Lanes::all(7)}, b{1, {}, Lanes::all(7), Lanes::all(7)};
  ResidualModels models(2), fresh(2);
  TwoEndedEncoder scratch, expected, given;
  for (int i = 0; i < 100; ++i) code(models, scratch, a, {3, 3, 3, 0});
  for (int i = 0; i < 20; ++i) {
    code(models, given, b, {1, 0, 1, 0});
    code(fresh, expected, b, {1, 0, 1, 0});
  }
  EXPECT_EQ(given.finish(), expected.finish());
}

TEST(ResidualModels, RandomBytesYieldBoundedResiduals) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint8_t> bytes(200);
    for (std::uint8_t& byte : bytes) byte = round % 3 == 0 ? 0xFF : static_cast<std::uint8_t>(random());
    TwoEndedDecoder decoder(bytes);
    ResidualModels models(1);
    for (int i = 0; i < 100; ++i) {
      for (const std::int32_t value : code(models, decoder, random_choice(1, random)))
        ASSERT_LE(std::abs(value), 1 << 27);
    }
  }
}

}  // namespace
}  // namespace tvg
