#include "modes/lossless_header.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace tvg {
namespace {

using Buffer = std::vector<std::uint8_t>;

Result<LosslessHeader> read(Bytes fields, Bytes planes = {}) {
  GopHeader header;
  header.mode = kModeLossless;
  header.planes = planes;
  header.fields = fields;
  LosslessHeader lossless;
  const Status status = read_lossless_header(header, lossless);
  return status.ok() ? Result<LosslessHeader>(lossless) : Result<LosslessHeader>(status.error());
}

ErrorCode code(Bytes fields, Bytes planes = {}) {
  const Result<LosslessHeader> header = read(fields, planes);
  return header ? ErrorCode{} : header.error().code;
}

TEST(LosslessHeader, ComesBack) {
  for (const LineChoice& line :
       {LineChoice{}, LineChoice{.low_bits = 23}, LineChoice{.multiples = true, .exponent = -149},
        LineChoice{.multiples = true, .exponent = 103}}) {
    Buffer fields = {1, 1};
    const Buffer behind = write_lossless_header(line);
    fields.insert(fields.end(), behind.begin(), behind.end());
    const Result<LosslessHeader> back = read(fields);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->line, line);
    for (std::size_t length = 0; length < fields.size(); ++length)
      EXPECT_EQ(code(Bytes(fields).first(length)), ErrorCode::kMalformed) << length;
  }
}

TEST(LosslessHeader, EveryFieldOutOfRangeIsRefused) {
  EXPECT_EQ(code(Buffer{1, 1, 0, 0}), ErrorCode{});
  EXPECT_EQ(code(Buffer{1, 1, 0, 24}), ErrorCode::kMalformed) << "more bits than a fraction has";
  EXPECT_EQ(code(Buffer{1, 1, 1, 253}), ErrorCode::kMalformed) << "multiples beyond float32";
  EXPECT_EQ(code(Buffer{1, 1, 2, 0}), ErrorCode::kMalformed) << "a kind that is not known";
  EXPECT_EQ(code(Buffer{1, 1, 0, 0, 0}), ErrorCode::kMalformed) << "a byte left over";
  EXPECT_EQ(code(Buffer{1, 2, 0, 0}), ErrorCode::kMalformed) << "positions come first";
  EXPECT_EQ(code(Buffer{2, 1, 3, 0, 0}), ErrorCode::kUnsupported) << "an odd channel";
  EXPECT_EQ(code(Buffer{2, 1, 4, 0, 0}), ErrorCode{}) << "an even one";
  EXPECT_EQ(code(Buffer{1, 1, 0, 0}, Buffer{1, 2, 3, 4}), ErrorCode::kMalformed) << "planes";
}

}  // namespace
}  // namespace tvg
