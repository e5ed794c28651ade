#include "tool/player_page.hpp"

#include "tool/tool_error.hpp"

#include <gtest/gtest.h>

namespace tvg::cli::testing {
namespace {

TEST(PlayerPage, EncodesBase64AsRfc4648Does) {
  for (const auto& [bytes, text] :
       {std::pair("", ""), std::pair("f", "Zg=="), std::pair("fo", "Zm8="), std::pair("foo", "Zm9v"),
        std::pair("foob", "Zm9vYg=="), std::pair("fooba", "Zm9vYmE="), std::pair("foobar", "Zm9vYmFy"),
        std::pair("\xff\xfe\xfd", "//79")}) {
    EXPECT_EQ(base64(bytes), text);
  }
}

TEST(PlayerPage, KeepsWhatItDoesNotReplace) {
  PlayerPage page("<p>\n<main lang=\"en\" data-poster=\"old.png\" id=\"player\">\n</main>", "page");
  page.set({"A & B", "a.tvg", ""});
  EXPECT_EQ(page.html(),
            "<p>\n<main lang=\"en\" id=\"player\" data-stream=\"a.tvg\" data-title=\"A &amp; B\">\n</main>");
}

TEST(PlayerPage, RefusesAPageThatLacksWhatIsToBeReplaced) {
  PlayerPage page("<main></main>", "page");
  EXPECT_THROW(page.set({}), ToolError);
  EXPECT_THROW(page.set_base("/a/"), ToolError);
  EXPECT_THROW(page.embed("", ""), ToolError);
  EXPECT_THROW(page.insert_before_script(""), ToolError);
}

}  // namespace
}  // namespace tvg::cli::testing
