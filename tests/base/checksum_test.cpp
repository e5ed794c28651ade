#include "base/checksum.hpp"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <span>
#include <vector>

namespace tvg {
namespace {

TEST(Checksum, IsTheLowHalfOfXxh64) {
  // XXH64 of no bytes with seed 0 is EF46DB3751D8E999.
  EXPECT_EQ(Hasher().value(), 0xEF46DB3751D8E999u);
  EXPECT_EQ(checksum({}), 0x51D8E999u);
  // XXH64 of "a": D24EC4F1A98C6E5B.
  EXPECT_EQ(checksum(std::array<std::uint8_t, 1>{'a'}), 0xA98C6E5Bu);
}

TEST(Checksum, PiecesHashAsTheWhole) {
  std::vector<std::uint8_t> bytes(300);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 7);
  for (const std::size_t piece : {1u, 3u, 31u, 32u, 33u, 299u}) {
    Hasher hasher;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      hasher.update(std::span<const std::uint8_t>(bytes).subspan(at, std::min(piece, bytes.size() - at)));
    }
    EXPECT_EQ(static_cast<std::uint32_t>(hasher.value()), checksum(bytes));
  }
}

TEST(Checksum, IntegersCountAsLittleEndianBytes) {
  Hasher integers, bytes;
  integers.update(std::array<std::int32_t, 2>{0x01020304, -2});
  bytes.update(std::array<std::uint8_t, 8>{4, 3, 2, 1, 0xFE, 0xFF, 0xFF, 0xFF});
  EXPECT_EQ(integers.value(), bytes.value());
}

}  // namespace
}  // namespace tvg
