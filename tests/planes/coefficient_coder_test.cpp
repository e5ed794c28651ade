#include "coefficient_trace.hpp"

#include <gtest/gtest.h>
#include <random>
#include <span>
#include <vector>

namespace tvg::test {

std::vector<std::vector<std::uint8_t>> trace_plain_coefficients(std::uint32_t seed);

namespace {

constexpr auto kNothing = [](const auto&...) { return Quad{}; };

TEST(CoefficientCoder, GivesBackEveryCoefficient) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Pyramid pyramid = random_pyramid(150, 4 + seed % 13, random);
    const int nested = seed % 2 == 0 ? 0 : 3;
    std::vector<std::uint8_t> flags;
    for (int v = 0; nested > 0 && v < 150; ++v) flags.push_back(random() % 2);
    CoefficientCoder writer(pyramid, flags, nested), reader(pyramid, flags, nested);
    for (const std::int32_t most : {kMostCoefficient, 100000, 40, 3, 0, 1}) {
      std::vector<Quad> wanted(150);
      const std::size_t count = most == 1 ? 3 : 4;
      for (std::size_t v = 0; v < wanted.size(); ++v) {
        const int shift = flags.empty() || flags[v] != 0 ? 0 : nested;
        for (std::size_t j = 0; j < count; ++j)
          wanted[v][j] = std::uniform_int_distribution(-most, most)(random) >> shift << shift;
      }
      RangeEncoder encoder;
      std::vector<Quad> written(150), read(150);
      ASSERT_TRUE(writer.code(encoder, written, count, Wanted{wanted}));
      ASSERT_EQ(written, wanted);
      const std::vector<std::uint8_t> bytes = encoder.finish();
      RangeDecoder decoder(bytes);
      ASSERT_TRUE(reader.code(decoder, read, count, kNothing));
      ASSERT_TRUE(decoder.finished());
      ASSERT_EQ(read, wanted);
    }
  }
}

TEST(CoefficientCoder, CodesTheSameWithAndWithoutVectors) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const std::vector<std::vector<std::uint8_t>> groups = trace_coefficients(seed);
    ASSERT_EQ(groups, trace_plain_coefficients(seed));
    ASSERT_GT(groups[0].size(), groups[4].size());
  }
}

TEST(CoefficientCoder, KeepsItsBoundsWhateverTheBytes) {
  std::mt19937 random(4);
  for (int run = 0; run < 60; ++run) {
    const Pyramid pyramid = random_pyramid(300, 16, random);
    CoefficientCoder coder(pyramid, {}, 0);
    for (int group = 0; group < 3; ++group) {
      std::vector<std::uint8_t> bytes(random() % 3000);
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(run % 3 == 0 ? 255 : random());
      RangeDecoder decoder(bytes);
      std::vector<Quad> values(300);
      coder.code(decoder, values, 4, kNothing);
      for (const Quad& quad : values) {
        for (const std::int32_t value : quad)
          ASSERT_TRUE(value >= -kMostCoefficient && value <= kMostCoefficient);
      }
    }
  }
}

}  // namespace
}  // namespace tvg::test
