#include "entropy/range_coder.hpp"

#include "entropy/code_bits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {
namespace {

/// One call of the coder.
struct Call {
  enum class Kind { kSymbol, kMixture, kBit, kRaw } kind;
  std::size_t model;
  std::uint32_t value;
  int raw_bits;

  bool operator==(const Call&) const = default;
};

/// Sends calls through a coder with models of its own; the values that come out.
template <class Coder>
std::vector<std::uint32_t> run(Coder& coder, const std::vector<Call>& calls) {
  std::vector<AdaptiveSymbol> symbols(4, AdaptiveSymbol(16));
  std::vector<AdaptiveBit> bits(4);
  std::vector<std::uint32_t> values;
  for (const Call& call : calls) {
    switch (call.kind) {
      case Call::Kind::kSymbol:
        values.push_back(coder.code(symbols[call.model], call.value));
        break;
      case Call::Kind::kMixture:
        values.push_back(coder.code(symbols[call.model], symbols[(call.model + 1) % 4], call.value));
        break;
      case Call::Kind::kBit:
        values.push_back(coder.code(bits[call.model], call.value != 0) ? 1 : 0);
        break;
      case Call::Kind::kRaw:
        values.push_back(coder.code_raw(call.value, call.raw_bits));
        break;
    }
  }
  return values;
}

/// Random calls; the larger `skew`, the more values are zero.
std::vector<Call> random_calls(std::size_t count, unsigned skew, std::mt19937& random) {
  std::vector<Call> calls(count);
  for (Call& call : calls) {
    call.kind = static_cast<Call::Kind>(random() % 4);
    call.model = random() % 4;
    call.raw_bits = static_cast<int>(random() % 16);
    const std::uint32_t limit = call.kind == Call::Kind::kBit   ? 2
                                : call.kind == Call::Kind::kRaw ? 1u << call.raw_bits
                                                                : 16;
    call.value = random() % skew == 0 ? static_cast<std::uint32_t>(random() % limit) : 0;
  }
  return calls;
}

std::vector<std::uint32_t> values_of(const std::vector<Call>& calls) {
  std::vector<std::uint32_t> values;
  for (const Call& call : calls) values.push_back(call.value);
  return values;
}

std::vector<std::uint8_t> encode_calls(const std::vector<Call>& calls) {
  RangeEncoder encoder;
  run(encoder, calls);
  return encoder.finish();
}

TEST(RangeCoder, RandomCallsComeBackAndFillTheStreamExactly) {
  std::mt19937 random(2);
  for (std::size_t round = 0; round < 400; ++round) {
    const std::vector<Call> calls = random_calls(round * 3, 1 + static_cast<unsigned>(round % 40), random);
    const std::vector<std::uint8_t> bytes = encode_calls(calls);
    RangeDecoder decoder(bytes);
    ASSERT_EQ(run(decoder, calls), values_of(calls)) << "round " << round;
    ASSERT_TRUE(decoder.finished()) << "round " << round;
    ASSERT_FALSE(decoder.overrun());
  }
}

TEST(RangeCoder, EncoderIsEmptyAgainAfterFinish) {
  std::mt19937 random(3);
  const std::vector<Call> calls = random_calls(300, 2, random);
  RangeEncoder encoder;
  run(encoder, random_calls(100, 3, random));
  (void)encoder.finish();
  run(encoder, calls);
  EXPECT_EQ(encoder.finish(), encode_calls(calls));
}

TEST(RangeCoder, EveryShortStreamThatFinishesIsTheOneTheEncoderWrites) {
  std::size_t finished = 0;
  std::vector<Call> calls = {
      {Call::Kind::kSymbol, 0, 0, 0}, {Call::Kind::kBit, 0, 0, 0}, {Call::Kind::kRaw, 0, 0, 3}};
  for (std::size_t length = 0; length <= 2; ++length) {
    for (std::uint32_t value = 0; value < 1u << (8 * length); ++value) {
      std::vector<std::uint8_t> bytes;
      for (std::size_t i = 0; i < length; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
      RangeDecoder decoder(bytes);
      const std::vector<std::uint32_t> values = run(decoder, calls);
      if (!decoder.finished()) continue;
      ++finished;
      for (std::size_t i = 0; i < calls.size(); ++i) calls[i].value = values[i];
      ASSERT_EQ(encode_calls(calls), bytes);
    }
  }
  EXPECT_EQ(finished, 16u * 2 * 8) << "one stream for each combination of values";
}

TEST(RangeCoder, OneByteMoreOneByteLessOrAChangedLastByteIsRefused) {
  std::mt19937 random(4);
  for (std::size_t round = 0; round < 60; ++round) {
    const std::vector<Call> calls = random_calls(1 + round, 1 + static_cast<unsigned>(round % 5), random);
    const std::vector<std::uint8_t> good = encode_calls(calls);
    const auto passes = [&](const std::vector<std::uint8_t>& bytes) {
      RangeDecoder decoder(bytes);
      return run(decoder, calls) == values_of(calls) && decoder.finished();
    };
    ASSERT_TRUE(passes(good));
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::vector<std::uint8_t> longer = good, changed = good;
      longer.push_back(static_cast<std::uint8_t>(byte));
      changed.back() = static_cast<std::uint8_t>(byte);
      ASSERT_FALSE(passes(longer)) << "added " << byte;
      ASSERT_EQ(passes(changed), byte == good.back()) << "last byte " << byte;
    }
    ASSERT_FALSE(passes({good.begin(), good.end() - 1}));
  }
}

TEST(RangeCoder, NoTruncationFinishesOrReadsBeyondTheEnd) {
  std::mt19937 random(5);
  const std::vector<Call> calls = random_calls(200, 2, random);
  const std::vector<std::uint8_t> good = encode_calls(calls);
  for (std::size_t length = 0; length < good.size(); ++length) {
    const std::vector<std::uint8_t> cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    RangeDecoder decoder(cut);
    run(decoder, calls);
    ASSERT_FALSE(decoder.finished()) << length;
    if (length + 4 < good.size()) {
      ASSERT_TRUE(decoder.overrun()) << length;
    }
  }
}

TEST(RangeCoder, EmptyStreamOverrunsOnceABitIsUsed) {
  RangeDecoder decoder({});
  EXPECT_FALSE(decoder.overrun());
  EXPECT_FALSE(decoder.finished());
  for (int i = 0; i < 4; ++i) decoder.code_raw(0, 15);
  EXPECT_TRUE(decoder.overrun());
  EXPECT_FALSE(decoder.finished());
}

TEST(RangeCoder, CarriesRunThroughLongChainsOfBytes) {
  for (const unsigned first : {0x00u, 0x3Fu, 0x7Fu, 0x80u, 0xBFu, 0xFEu}) {
    for (const unsigned rest : {0x00u, 0xFFu}) {
      std::vector<std::uint8_t> chain(64, static_cast<std::uint8_t>(rest));
      chain.front() = static_cast<std::uint8_t>(first);
      // The calls such a stream decodes to: the encoder's `low` creeps along the chain with them.
      std::mt19937 random(6);
      std::vector<Call> calls = random_calls(60, 1, random);
      RangeDecoder reader(chain);
      const std::vector<std::uint32_t> values = run(reader, calls);
      ASSERT_FALSE(reader.overrun());
      for (std::size_t i = 0; i < calls.size(); ++i) calls[i].value = values[i];
      for (std::size_t count = 0; count <= calls.size(); ++count) {
        const std::vector<Call> some(calls.begin(), calls.begin() + static_cast<std::ptrdiff_t>(count));
        const std::vector<std::uint8_t> bytes = encode_calls(some);
        RangeDecoder decoder(bytes);
        ASSERT_EQ(run(decoder, some), values_of(some)) << first << ' ' << rest << ' ' << count;
        ASSERT_TRUE(decoder.finished());
      }
    }
  }
}

TEST(RangeCoder, RandomBytesDecodeToValuesInRange) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::vector<std::uint8_t> bytes(random() % 40);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    const std::vector<Call> calls = random_calls(200, 1, random);
    RangeDecoder decoder(bytes);
    const std::vector<std::uint32_t> values = run(decoder, calls);
    for (std::size_t i = 0; i < calls.size(); ++i) {
      const std::uint32_t limit = calls[i].kind == Call::Kind::kBit   ? 2
                                  : calls[i].kind == Call::Kind::kRaw ? 1u << calls[i].raw_bits
                                                                      : 16;
      ASSERT_LT(values[i], limit);
    }
  }
}

TEST(RangeCoder, SizeIsCloseToTheEntropyOfAKnownSource) {
  // P(symbol s) = 2^-(s + 1), the last one twice: entropy 2 - 2^-14 bits.
  std::mt19937 random(8);
  constexpr std::size_t kCount = 200000;
  RangeEncoder encoder;
  AdaptiveSymbol model;
  for (std::size_t i = 0; i < kCount; ++i) {
    encoder.code(model, static_cast<std::uint32_t>(std::countr_zero((random() & 0x7FFFu) | 0x8000u)));
  }
  const double bits = 8.0 * static_cast<double>(encoder.finish().size()) / kCount;
  EXPECT_GT(bits, 1.97);
  EXPECT_LT(bits, 2.0 * 1.05);
}

TEST(RangeCoder, RareBitsCostWhatTheirProbabilitySays) {
  std::mt19937 random(9);
  constexpr std::size_t kCount = 200000;
  RangeEncoder encoder;
  AdaptiveBit model;
  for (std::size_t i = 0; i < kCount; ++i) encoder.code(model, random() % 20 == 0);
  const double entropy = -0.05 * std::log2(0.05) - 0.95 * std::log2(0.95);
  const double bits = 8.0 * static_cast<double>(encoder.finish().size()) / kCount;
  EXPECT_GT(bits, 0.97 * entropy);
  EXPECT_LT(bits, 1.06 * entropy);
}

TEST(RangeCoder, RawBitsCostExactlyTheirNumber) {
  std::mt19937 random(10);
  RangeEncoder encoder;
  for (int i = 0; i < 8000; ++i) encoder.code_raw(static_cast<std::uint32_t>(random() % (1u << 11)), 11);
  EXPECT_EQ(encoder.finish().size(), 11001u) << "one bit more settles the stream";
}

TEST(RangeCoder, NumbersOfBitsAreTheSameInOneOrInPiecesAndComeBack) {
  std::mt19937 random(11);
  for (int count = 0; count <= 32; ++count) {
    const auto value =
        static_cast<std::uint32_t>(std::uint64_t{random()} & ((std::uint64_t{1} << count) - 1));
    RangeEncoder encoder, pieces;
    ASSERT_EQ(code_bits(encoder, value, count), value);
    int left = count;
    for (int some = 0; left > 0; left -= some) {
      some = std::min(left, 1 + static_cast<int>(random() % 15));
      pieces.code_raw((value >> (left - some)) & ((1u << some) - 1), some);
    }
    const std::vector<std::uint8_t> bytes = encoder.finish();
    EXPECT_EQ(bytes, pieces.finish()) << count << " bits";
    RangeDecoder decoder(bytes);
    EXPECT_EQ(code_bits(decoder, 0, count), value) << count << " bits";
    EXPECT_TRUE(decoder.finished());
  }
}

}  // namespace
}  // namespace tvg
