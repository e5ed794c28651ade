#pragma once
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <tvg/types.hpp>

// What the tests of single structures share.
namespace tvg {

using Buffer = std::vector<std::uint8_t>;

template <class T>
void expect_refused(const Result<T>& result, ErrorCode code, const std::string& section) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_EQ(result.error().section, section);
  EXPECT_FALSE(result.error().message.empty());
}

/// Every truncation, and one byte more, is refused.
template <class Read>
void expect_exact_length(const Buffer& good, Read read) {
  ASSERT_TRUE(read(good));
  for (std::size_t length = 0; length < good.size(); ++length) {
    const Buffer cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_FALSE(read(cut)) << length;
  }
  Buffer longer = good;
  longer.push_back(0);
  EXPECT_FALSE(read(longer));
}

}  // namespace tvg
