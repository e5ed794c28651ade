#include "player/render/sheet.hpp"

#include "player/render/picture.hpp"

#include <gtest/gtest.h>

namespace tvg::player {
namespace {

TEST(SpreadEvenly, TakesTheFirstAndTheLast) {
  EXPECT_EQ(spread_evenly(100, 4), (std::vector<std::uint64_t>{0, 33, 66, 99}));
  EXPECT_EQ(spread_evenly(3, 12), (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(spread_evenly(50, 1), (std::vector<std::uint64_t>{0}));
}

TEST(SheetShape, HasRoomForTheFramesAndFewEmptyCells) {
  for (std::uint64_t frames = 1; frames < 40; ++frames) {
    const SheetShape shape = sheet_shape(frames, 1280, 720);
    const int wanted = static_cast<int>(std::min<std::uint64_t>(frames, 12));
    EXPECT_GE(shape.columns * shape.rows, wanted);
    EXPECT_LE(shape.columns * shape.rows, wanted + 2);
  }
  EXPECT_EQ(sheet_shape(400, 1280, 720).columns, 4);
}

TEST(SheetCells, FillThePicture) {
  int area = 0;
  for (const Cell& cell : sheet_cells(101, 67, 3, 4)) area += cell.width * cell.height;
  EXPECT_EQ(area, 101 * 67);
}

}  // namespace
}  // namespace tvg::player
