#include "base/byte_io.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace tvg {
namespace {

TEST(ByteIo, ValuesComeBackAndLieLittleEndian) {
  ByteWriter writer;
  writer.u8(0x12);
  writer.u16(0x3456);
  writer.u32(0x789ABCDE);
  writer.u64(0x0123456789ABCDEF);
  writer.f64(-0.15625);
  EXPECT_EQ(writer.data()[1], 0x56);
  EXPECT_EQ(writer.data()[3], 0xDE);
  ByteReader reader(writer.data());
  EXPECT_EQ(reader.u8(), 0x12u);
  EXPECT_EQ(reader.u16(), 0x3456u);
  EXPECT_EQ(reader.u32(), 0x789ABCDEu);
  EXPECT_EQ(reader.u64(), 0x0123456789ABCDEFu);
  EXPECT_EQ(reader.f64(), -0.15625);
  EXPECT_TRUE(reader.finished());
}

TEST(ByteIo, AReadBeyondTheEndYieldsZeroAndIsRemembered) {
  const std::vector<std::uint8_t> bytes = {1, 2, 3};
  ByteReader reader(bytes);
  EXPECT_EQ(reader.u32(), 0u);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.u8(), 0u) << "nor does anything after it succeed";
  EXPECT_FALSE(reader.finished());
  ByteReader spans(bytes);
  EXPECT_TRUE(spans.bytes(std::numeric_limits<std::uint64_t>::max()).empty());
  EXPECT_FALSE(spans.ok());
}

TEST(ByteIo, VarintsComeBackInTheirShortestForm) {
  for (int bit = 0; bit <= 64; ++bit) {
    for (const std::int64_t off : {-1, 0, 1}) {
      const std::uint64_t value = (bit == 64 ? 0 : std::uint64_t{1} << bit) + static_cast<std::uint64_t>(off);
      ByteWriter writer;
      writer.varint(value);
      const std::size_t bits = std::max(1, static_cast<int>(std::bit_width(value)));
      EXPECT_EQ(writer.data().size(), (bits + 6) / 7);
      ByteReader reader(writer.data());
      EXPECT_EQ(reader.varint(), value);
      EXPECT_TRUE(reader.finished());
    }
  }
}

TEST(ByteIo, VarintsInALongerFormAreRefused) {
  const auto refused = [](std::vector<std::uint8_t> bytes) {
    ByteReader reader(bytes);
    return reader.varint() == 0 && !reader.ok();
  };
  EXPECT_TRUE(refused({0x80, 0x00})) << "0 in two bytes";
  EXPECT_TRUE(refused({0xFF, 0x00})) << "127 in two bytes";
  EXPECT_TRUE(refused({0x80, 0x80, 0x00}));
  EXPECT_TRUE(refused({0x80})) << "cut";
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x02})) << "65 bits";
  EXPECT_TRUE(refused({0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x81, 0x01})) << "eleven bytes";
  EXPECT_FALSE(refused({0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x01})) << "the largest value";
}

TEST(ByteIo, EveryTwoByteStringIsAtMostOneVarint) {
  for (std::uint32_t pair = 0; pair < 65536; ++pair) {
    const std::vector<std::uint8_t> bytes = {static_cast<std::uint8_t>(pair),
                                             static_cast<std::uint8_t>(pair >> 8)};
    ByteReader reader(bytes);
    const std::uint64_t value = reader.varint();
    if (!reader.finished()) continue;
    ByteWriter writer;
    writer.varint(value);
    ASSERT_EQ(writer.data(), bytes);
  }
}

}  // namespace
}  // namespace tvg
