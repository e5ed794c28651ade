#include "quantization/flag_coder.hpp"

#include "entropy/range_coder.hpp"

#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {
namespace {

/// Gates of a strip: vertex v is reached through the three before it; the first three have no whole gate.
std::vector<Gate> strip(std::uint32_t count) {
  std::vector<Gate> gates(count);
  for (std::uint32_t v = 3; v < count; ++v) gates[v] = {v - 1, v - 2, v - 3};
  return gates;
}

std::vector<std::uint8_t> encode_flags(const std::vector<Gate>& gates, std::vector<std::uint8_t> flags) {
  RangeEncoder encoder;
  code_flags(encoder, gates, flags);
  return encoder.finish();
}

TEST(FlagCoder, FlagsComeBackWhateverTheirShare) {
  std::mt19937 random(1);
  const std::vector<Gate> gates = strip(500);
  for (const double share : {0.0, 0.01, 0.35, 0.5, 1.0}) {
    std::vector<std::uint8_t> flags(gates.size()), back(gates.size(), 1);
    std::bernoulli_distribution flagged(share);
    for (std::uint8_t& flag : flags) flag = flagged(random) ? 1 : 0;
    const std::vector<std::uint8_t> bytes = encode_flags(gates, flags);
    RangeDecoder decoder(bytes);
    code_flags(decoder, gates, back);
    EXPECT_EQ(back, flags) << share;
    EXPECT_TRUE(decoder.finished()) << share;
  }
}

TEST(FlagCoder, RegionsCostLessThanScatteredFlags) {
  std::mt19937 random(2);
  const std::vector<Gate> gates = strip(4000);
  std::vector<std::uint8_t> regions(gates.size()), scattered(gates.size());
  for (std::size_t v = 0; v < gates.size(); ++v) {
    regions[v] = (v / 200) % 2;
    scattered[v] = random() % 2;
  }
  EXPECT_LT(4 * encode_flags(gates, regions).size(), encode_flags(gates, scattered).size());
}

}  // namespace
}  // namespace tvg
