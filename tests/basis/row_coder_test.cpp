#include "basis/row_coder.hpp"

#include "entropy/range_coder.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {
namespace {

using Frame = std::vector<std::int32_t>;
using Packet = std::vector<std::uint8_t>;

const std::vector<std::uint8_t> kScales = {0, 3, 10, 21, 32, 255, 40};
const std::size_t kValues = 3 * kScales.size();

std::vector<Packet> encoded(const std::vector<Frame>& frames) {
  RowCoder coder(kScales);
  std::vector<Packet> packets;
  for (Frame frame : frames) {
    RangeEncoder encoder;
    EXPECT_TRUE(coder.code_frame(encoder, std::span(frame)));
    packets.push_back(encoder.finish());
  }
  return packets;
}

void expect_decodes_to(const std::vector<Packet>& packets, const std::vector<Frame>& frames) {
  RowCoder coder(kScales);
  for (std::size_t f = 0; f < packets.size(); ++f) {
    RangeDecoder decoder(packets[f]);
    Frame decoded(kValues, INT32_MIN);
    ASSERT_TRUE(coder.code_frame(decoder, std::span(decoded))) << f;
    EXPECT_TRUE(decoder.finished()) << f;
    ASSERT_EQ(decoded, frames[f]) << f;
  }
}

std::size_t size_of(const std::vector<Packet>& packets) {
  std::size_t bytes = 0;
  for (const Packet& packet : packets) bytes += packet.size();
  return bytes;
}

/// Frames of [row][axis] values, each of them what `value(frame, place)` says.
template <class Value>
std::vector<Frame> frames_of(std::size_t count, Value value) {
  std::vector<Frame> frames(count, Frame(kValues));
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t i = 0; i < kValues; ++i) frames[f][i] = value(f, i);
  }
  return frames;
}

std::vector<Frame> random_walk(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  Frame at(kValues);
  return frames_of(count, [&](std::size_t, std::size_t i) {
    const auto reach = static_cast<std::int32_t>(2 * kValues - 2 * i);
    return at[i] += static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(2 * reach + 1)) - reach;
  });
}

TEST(RowCoder, ReturnsWhatWasEncoded) {
  const std::vector<Frame> frames = random_walk(150, 1);
  expect_decodes_to(encoded(frames), frames);
}

TEST(RowCoder, ReturnsExtremeValues) {
  std::mt19937 random(2);
  const std::vector<Frame> frames = frames_of(100, [&](std::size_t f, std::size_t i) {
    if (i % 4 == 0) return f % 2 == 0 ? RowCoder::kMostValue : -RowCoder::kMostValue;
    if (i % 4 == 1) return static_cast<std::int32_t>(random() >> (6 + random() % 26)) - (f % 7 == 0 ? 1 : 0);
    return i % 4 == 2 ? RowCoder::kMostValue : 0;
  });
  expect_decodes_to(encoded(frames), frames);
}

TEST(RowCoder, RefusesToEncodeWhatIsOutOfBounds) {
  for (const std::int32_t value :
       {RowCoder::kMostValue + 1, -RowCoder::kMostValue - 1, INT32_MIN, INT32_MAX}) {
    RowCoder coder(kScales);
    RangeEncoder encoder;
    Frame frame(kValues);
    frame[5] = value;
    EXPECT_FALSE(coder.code_frame(encoder, std::span(frame))) << value;
  }
}

TEST(RowCoder, HardlySpendsAnythingOnWhatStandsStill) {
  const std::vector<Frame> frames =
      frames_of(100, [](std::size_t, std::size_t i) { return 1000 - 90 * static_cast<std::int32_t>(i); });
  const std::vector<Packet> packets = encoded(frames);
  expect_decodes_to(packets, frames);
  EXPECT_LE(packets.back().size(), 2u);
}

TEST(RowCoder, LearnsMotionThatComesAgain) {
  std::mt19937 random(3);
  std::vector<Frame> cycle = frames_of(
      11, [&](std::size_t, std::size_t) { return static_cast<std::int32_t>(random() % 2001) - 1000; });
  const std::vector<Frame> frames = frames_of(64, [&](std::size_t f, std::size_t i) {
    return cycle[f % cycle.size()][i] + static_cast<std::int32_t>(random() % 5);
  });
  std::vector<Packet> packets = encoded(frames);
  expect_decodes_to(packets, frames);
  const std::vector<Packet> first(packets.begin(), packets.begin() + 11),
      last(packets.end() - 11, packets.end());
  EXPECT_LT(2 * size_of(last), size_of(first));
}

TEST(RowCoder, BeginsAnewEachTime) {
  const std::vector<Frame> frames = random_walk(20, 4);
  EXPECT_EQ(encoded(frames), encoded(frames));
}

TEST(RowCoder, StaysWithinBoundsWhateverTheBytes) {
  std::mt19937 random(5);
  const std::vector<Packet> good = encoded(random_walk(80, 6));
  int refused = 0;
  for (int round = 0; round < 200; ++round) {
    RowCoder coder(kScales);
    for (std::size_t f = 0; f < good.size(); ++f) {
      Packet packet = good[f];
      if (round % 2 == 0) {
        packet.resize(random() % 400);
        for (std::uint8_t& byte : packet) byte = static_cast<std::uint8_t>(round % 4 == 0 ? random() : 0xFF);
      } else if (!packet.empty() && f > static_cast<std::size_t>(round) % 80) {
        packet[random() % packet.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
      }
      RangeDecoder decoder(packet);
      Frame decoded(kValues, INT32_MAX);
      if (!coder.code_frame(decoder, std::span(decoded))) {
        ++refused;
        break;
      }
      for (const std::int32_t value : decoded) ASSERT_LE(std::abs(value), RowCoder::kMostValue);
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(RowCoder, StaysWithinBoundsWhenValuesJumpForLong) {
  std::mt19937 random(7);
  // Symbols at random, so that the decoder goes where no encoder would lead it, for as long as it takes.
  for (int round = 0; round < 20; ++round) {
    RowCoder coder(kScales);
    for (int f = 0; f < 300; ++f) {
      Packet packet(1000);
      for (std::uint8_t& byte : packet) byte = static_cast<std::uint8_t>(random());
      packet[0] = static_cast<std::uint8_t>(packet[0] & 0x7F);
      RangeDecoder decoder(packet);
      Frame decoded(kValues);
      if (!coder.code_frame(decoder, std::span(decoded))) break;
      for (const std::int32_t value : decoded) ASSERT_LE(std::abs(value), RowCoder::kMostValue);
    }
  }
}

}  // namespace
}  // namespace tvg
