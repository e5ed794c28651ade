#include "player/view/find_font.hpp"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace tvg::player {
namespace {

void expect_file_or_nothing(const std::string& font) {
  if (!font.empty()) {
    EXPECT_TRUE(std::filesystem::is_regular_file(font)) << font;
  }
}

TEST(FindFont, GivesAFileOrNothingWhateverFontconfigIsToldToRead) {
  expect_file_or_nothing(find_font());
  for (const char* configuration : {"/dev/null", "/no/such/file", "/"}) {
    ASSERT_EQ(::setenv("FONTCONFIG_FILE", configuration, 1), 0);
    expect_file_or_nothing(find_font());
  }
  ::unsetenv("FONTCONFIG_FILE");
}

}  // namespace
}  // namespace tvg::player
