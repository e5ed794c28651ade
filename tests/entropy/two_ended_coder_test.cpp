#include "entropy/two_ended_coder.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {
namespace {

/// Bits in three planes: how many each call codes, and their value.
struct Call {
  std::size_t plane;
  int count;
  std::uint32_t value;
};

/// `share` of 100 calls are in the second plane, which the back is for.
std::vector<Call> random_calls(std::size_t count, unsigned share, std::mt19937& random) {
  std::vector<Call> calls(count);
  for (Call& call : calls) {
    call.plane = random() % 100 < share ? 1 : 2 * (random() % 2);
    call.count = static_cast<int>(random() % 16);
    call.value = static_cast<std::uint32_t>(random() % (1u << call.count));
  }
  return calls;
}

/// Raw bits and symbols; false where another value comes out.
template <class Coder>
bool run(Coder& coder, const std::vector<Call>& calls) {
  std::vector<AdaptiveSymbol> models(3);
  bool same = true;
  for (const Call& call : calls) {
    auto& lane = coder.lane(call.plane);
    same = lane.code_raw(Coder::kDecoding ? 0 : call.value, call.count) == call.value && same;
    same = lane.code(models[call.plane], Coder::kDecoding ? 0 : call.value % 16) == call.value % 16 && same;
  }
  return same;
}

std::vector<std::uint8_t> encode(const std::vector<Call>& calls) {
  TwoEndedEncoder encoder;
  run(encoder, calls);
  return encoder.finish();
}

bool passes(std::span<const std::uint8_t> bytes, const std::vector<Call>& calls) {
  TwoEndedDecoder decoder(bytes);
  return run(decoder, calls) && !decoder.overrun() && decoder.finished();
}

TEST(TwoEndedCoder, ValuesOfBothEndsComeBackHoweverTheyShareTheBytes) {
  std::mt19937 random(1);
  for (std::size_t round = 0; round < 600; ++round) {
    const std::vector<Call> calls = random_calls(round / 2, static_cast<unsigned>(round % 101), random);
    ASSERT_TRUE(passes(encode(calls), calls)) << "round " << round;
  }
}

TEST(TwoEndedCoder, CostsABitAndTheRestOfAByteForEachEnd) {
  const std::vector<std::uint8_t> nothing = encode({});
  EXPECT_EQ(nothing, (std::vector<std::uint8_t>{0, 0}));
  std::mt19937 random(2);
  const std::vector<Call> calls = random_calls(300, 33, random);
  RangeEncoder front, back;
  std::vector<AdaptiveSymbol> models(3);
  for (const Call& call : calls) {
    RangeEncoder& lane = call.plane == 1 ? back : front;
    lane.code_raw(call.value, call.count);
    lane.code(models[call.plane], call.value % 16);
  }
  EXPECT_EQ(encode(calls).size(), front.finish().size() + back.finish().size());
}

TEST(TwoEndedCoder, OneByteMoreOrLessOrBetweenTheEndsIsRefused) {
  std::mt19937 random(3);
  for (std::size_t round = 0; round < 40; ++round) {
    const std::vector<Call> calls = random_calls(1 + round, 40, random);
    const std::vector<std::uint8_t> good = encode(calls);
    for (std::size_t at = 0; at <= good.size(); ++at) {
      for (const unsigned byte : {0x00u, 0x01u, 0x80u, 0xFFu}) {
        std::vector<std::uint8_t> longer = good;
        longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(at), static_cast<std::uint8_t>(byte));
        ASSERT_FALSE(passes(longer, calls)) << byte << " at " << at;
      }
      if (at == good.size()) break;
      std::vector<std::uint8_t> shorter = good;
      shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(at));
      ASSERT_FALSE(passes(shorter, calls)) << "without " << at;
    }
  }
}

TEST(TwoEndedCoder, EveryChangedBitChangesAValueOrIsRefused) {
  std::mt19937 random(4);
  for (std::size_t round = 0; round < 30; ++round) {
    const std::vector<Call> calls = random_calls(round, 50, random);
    std::vector<std::uint8_t> bytes = encode(calls);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << bit % 8));
      ASSERT_FALSE(passes(bytes, calls)) << "bit " << bit;
      bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << bit % 8));
    }
  }
}

TEST(TwoEndedCoder, EveryShortStreamThatFinishesIsTheOneTheEncoderWrites) {
  std::size_t finished = 0;
  for (std::size_t length = 0; length <= 3; ++length) {
    for (std::uint32_t value = 0; value < 1u << (8 * length); value += length == 3 ? 17 : 1) {
      std::vector<std::uint8_t> bytes;
      for (std::size_t i = 0; i < length; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
      TwoEndedDecoder decoder(bytes);
      AdaptiveSymbol model, other;
      const std::uint32_t symbol = decoder.lane(0).code(model, other, 0),
                          raw = decoder.lane(1).code_raw(0, 5);
      if (!decoder.finished()) continue;
      ++finished;
      TwoEndedEncoder encoder;
      AdaptiveSymbol again, other_again;
      encoder.lane(0).code(again, other_again, symbol);
      encoder.lane(1).code_raw(raw, 5);
      ASSERT_EQ(encoder.finish(), bytes);
    }
  }
  EXPECT_EQ(finished, 16u * 32) << "one stream for each pair of values";
}

TEST(TwoEndedCoder, OverrunsOnceBothEndsTogetherUseMoreBitsThanThereAre) {
  const std::vector<std::uint8_t> bytes(8, 0x55);
  TwoEndedDecoder decoder(bytes);
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(decoder.overrun());
    decoder.lane(0).code_raw(0, 8);
    decoder.lane(1).code_raw(0, 8);
  }
  EXPECT_FALSE(decoder.overrun());
  decoder.lane(1).code_raw(0, 1);
  EXPECT_TRUE(decoder.overrun());
  EXPECT_FALSE(decoder.finished());
}

}  // namespace
}  // namespace tvg
