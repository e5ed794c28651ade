// Pictures are compared with those in tests/view/pictures. After a change that is meant to be seen, they are
// made anew, and looked at, with TVG_STORE_PICTURES=1 build/release/tests/view_tests
#include "tests/view/pictures.hpp"

#include "player/view/offscreen_context.hpp"
#include "tool/tool_error.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

namespace tvg::player::testing {
namespace {

// All are drawn by Mesa's software renderer. Its versions differ in the last bit of a colour and in a few
// samples along edges: a difference of up to 24 of 255 in a pixel is let pass (one sample of four is 25 % of
// the contrast at an edge), more in at most 1 pixel of 1000 (an outline is 10 to 20 of these), and 0.4 on
// average over the picture.
constexpr int kFar = 24;
constexpr double kMostFar = 0.001;
constexpr double kMostMean = 0.4;

std::string stored_path(std::string_view name) {
  return std::string(TVG_PICTURES) + "/" + std::string(name) + ".png";
}

bool alike(const Image& a, const Image& b) {
  const ImageDifference difference = compare_images(a, b, kFar);
  return difference.mean <= kMostMean && difference.far_share <= kMostFar;
}

class Pictures : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    try {
      const OffscreenContext context;
    } catch (const cli::ToolError& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

TEST_F(Pictures, LookAsTheStoredOnes) {
  const bool store = std::getenv("TVG_STORE_PICTURES") != nullptr;
  for (const StoredPicture& picture : stored_pictures()) {
    const Image drawn = picture.draw();
    if (store) write_png(stored_path(picture.name), drawn);
    const Image stored = read_png(stored_path(picture.name));
    const ImageDifference difference = compare_images(drawn, stored, kFar);
    EXPECT_LE(difference.mean, kMostMean) << picture.name;
    EXPECT_LE(difference.far_share, kMostFar) << picture.name;
  }
}

TEST_F(Pictures, OfTheSameFrameAreTheSameBytes) {
  EXPECT_EQ(draw_hand(5).pixels, draw_hand(5).pixels);
}

TEST_F(Pictures, OfAnotherFrameAreFoundWrong) {
  EXPECT_FALSE(alike(draw_hand(6), read_png(stored_path("smooth"))));
}

TEST_F(Pictures, WithoutSomeFacesAreFoundWrong) {
  EXPECT_FALSE(alike(draw_hand_without_some_faces(), read_png(stored_path("smooth"))));
}

TEST_F(Pictures, InAnotherColourAreFoundWrong) {
  EXPECT_FALSE(alike(draw_hand_in_another_colour(), read_png(stored_path("smooth"))));
}

TEST_F(Pictures, DifferFromEachOther) {
  const auto pictures = stored_pictures();
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    EXPECT_FALSE(alike(read_png(stored_path(pictures[i - 1].name)), read_png(stored_path(pictures[i].name))))
        << pictures[i].name;
  }
}

}  // namespace
}  // namespace tvg::player::testing
