#include "player/view/image.hpp"

#include "tests/importers/io_toolbox.hpp"
#include "tool/tool_error.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

namespace tvg::player {
namespace {

Image gradient(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.pixels.insert(image.pixels.end(),
                          {static_cast<std::uint8_t>(7 * x), static_cast<std::uint8_t>(11 * y), 90, 255});
    }
  }
  return image;
}

cli::ExitStatus status_of_reading(const std::string& path) {
  try {
    read_png(path);
  } catch (const cli::ToolError& error) {
    return error.status();
  }
  return cli::ExitStatus::kSuccess;
}

TEST(Png, ComesBackAsItWasWritten) {
  const cli::testing::TemporaryFolder folder;
  const Image image = gradient(31, 17);
  write_png(folder.path("a.png"), image);
  const Image back = read_png(folder.path("a.png"));
  EXPECT_EQ(back.width, 31);
  EXPECT_EQ(back.height, 17);
  EXPECT_EQ(back.pixels, image.pixels);
}

TEST(Png, OfOneImageIsAlwaysTheSameBytes) {
  const cli::testing::TemporaryFolder folder;
  write_png(folder.path("a.png"), gradient(31, 17));
  write_png(folder.path("b.png"), gradient(31, 17));
  EXPECT_EQ(folder.read("a.png"), folder.read("b.png"));
  EXPECT_EQ(folder.read("a.png").find("tIME"), std::string::npos);
}

TEST(Png, CutAnywhereIsRefusedNotCrashedOn) {
  const cli::testing::TemporaryFolder folder;
  write_png(folder.path("a.png"), gradient(31, 17));
  const std::string whole = folder.read("a.png");
  for (std::size_t size = 0; size + 16 < whole.size(); ++size) {
    folder.write("cut.png", whole.substr(0, size));
    EXPECT_EQ(status_of_reading(folder.path("cut.png")), cli::ExitStatus::kInvalidInput) << size;
  }
  EXPECT_EQ(status_of_reading(folder.path("none.png")), cli::ExitStatus::kIo);
}

TEST(CompareImages, MeasuresMeanAndShare) {
  Image a = gradient(10, 10);
  Image b = a;
  b.pixels[0] = static_cast<std::uint8_t>(b.pixels[0] + 30);
  const ImageDifference difference = compare_images(a, b, 29);
  EXPECT_DOUBLE_EQ(difference.mean, 30.0 / 300);
  EXPECT_DOUBLE_EQ(difference.far_share, 0.01);
  EXPECT_DOUBLE_EQ(compare_images(a, b, 30).far_share, 0);
  b.width = 5;
  EXPECT_THROW(compare_images(a, b, 0), std::invalid_argument);
}

}  // namespace
}  // namespace tvg::player
