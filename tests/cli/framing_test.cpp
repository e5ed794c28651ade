#include "tests/cli/tool_test_fixture.hpp"

#ifdef TVG_HAS_PLAYER
#include "player/view/image.hpp"

#include <algorithm>

namespace tvg::cli::testing {
namespace {

/// How `tvg render` places what it draws.
class Framing : public ToolTest {
 protected:
  void SetUp() override {
    const Outcome outcome = run("tvg render hand.obj -o probe.png --frames 0 --size 32x32 -q");
    if (outcome.err.find("cannot draw without a display") != std::string::npos) GTEST_SKIP() << outcome.err;
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  /// A box of two pixels a side and more that stands at `x` in each of its frames.
  void write_walk(const std::string& name, const std::vector<double>& places) const {
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::string text;
      for (int corner = 0; corner < 4; ++corner) {
        text += "v " + std::to_string(places[i] + (corner == 1 || corner == 2 ? 1 : 0)) + " " +
                (corner > 1 ? "1" : "0") + " 0\n";
      }
      folder_.write(name + "_" + std::to_string(i) + ".obj", text + "f 1 2 3 4\n");
    }
  }

  player::Image draw(const std::string& arguments) const {
    good("tvg render " + arguments + " -o drawn.png --background '#000000' -q");
    return player::read_png(folder_.path("drawn.png"));
  }

  struct Margins {
    int left = 0, right = 0, top = 0, bottom = 0;
    int narrowest() const { return std::min({left, right, top, bottom}); }
  };
  /// Pixels without anything at each side of a part of a picture.
  static Margins margins(const player::Image& image, int x = 0, int width = 0) {
    if (width == 0) width = image.width;
    Margins found{width, width, image.height, image.height};
    for (int row = 0; row < image.height; ++row) {
      for (int column = 0; column < width; ++column) {
        const std::uint8_t* const at = image.pixel(x + column, row);
        if (at[0] + at[1] + at[2] < 60) continue;
        found.left = std::min(found.left, column);
        found.right = std::min(found.right, width - 1 - column);
        found.top = std::min(found.top, row);
        found.bottom = std::min(found.bottom, image.height - 1 - row);
      }
    }
    return found;
  }
};

TEST_F(Framing, FillsThePictureFromEverywhereWithASmallMargin) {
  for (const std::string view : {"front", "right", "top", "iso", "30,15", "-140,-30"}) {
    for (const std::string size : {"200x100", "100x200"}) {
      const Margins at =
          margins(draw("hand.obj hand.pc2 --frames 4 --no-labels --camera=" + view + " --size " + size));
      const bool fills_width = at.left + at.right < at.top + at.bottom;
      const int smaller = fills_width ? at.left : at.top, larger = fills_width ? at.right : at.bottom;
      const int side = (size == "200x100") == fills_width ? 200 : 100;
      EXPECT_GE(at.narrowest(), 1) << view << " " << size;
      EXPECT_LE(smaller, side * 6 / 100) << view << " " << size;
      EXPECT_LE(larger, side * 6 / 100) << view << " " << size;
    }
  }
}

TEST_F(Framing, TakesInAllFramesThatAreDrawnAndNoOther) {
  write_walk("walk", {0, 3, 0, 20, 0});
  const std::string walk =
      "walk_0.obj walk_1.obj walk_2.obj walk_3.obj walk_4.obj --no-labels --camera front ";
  const player::Image near = draw(walk + "--frames 0-1 --sheet 2x1 --size 200x50");
  EXPECT_LE(margins(near, 0, 100).left, 5) << "frame 0 stands at the left edge of its cell";
  EXPECT_LE(margins(near, 100, 100).right, 5) << "frame 1 at the right edge of its own";
  EXPECT_GE(margins(near, 0, 100).narrowest(), 1);
  const player::Image ends = draw(walk + "--sheet 2x1 --size 200x100");  // of frames 0 and 4
  EXPECT_LE(margins(ends, 0, 100).top, 6) << "frame 3 goes far, and is not drawn";
  const player::Image far = draw(walk + "--frames 3 --size 100x100");
  EXPECT_LE(margins(far).top, 6);
}

TEST_F(Framing, IsThatOfTheStreamWhetherItCanBeReadTwiceOrHasAnIndex) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --bits 12:9 -q");
  const player::Image named = draw("hand.tvg --size 160x120");
  const std::string stream = folder_.read("hand.tvg");
  const auto index = chunks("hand.tvg", "INDX");
  if (!index.empty()) {
    folder_.write("cut.tvg", stream.substr(0, index[0].first));
    EXPECT_LT(player::compare_images(named, draw("cut.tvg --size 160x120 --conceal"), 24).mean, 0.1);
  }
}

TEST_F(Framing, TurnsWhatIsUpAndWhatIsTheFront) {
  // A tall board that leans neither way: 1 wide, 3 along the axis that is up.
  folder_.write("y.obj", "v 0 0 0\nv 1 0 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4\n");
  folder_.write("z.obj", "v 0 0 0\nv 1 0 0\nv 1 0 3\nv 0 0 3\nf 1 2 3 4\n");
  const std::string shape = " --camera front --size 96x96 --no-labels";
  const player::Image y = draw("y.obj" + shape), z = draw("z.obj --up +Z" + shape);
  EXPECT_EQ(y.pixels, z.pixels);
  good("tvg encode z.obj -o z.tvg --up z --bits 16 -q");
  EXPECT_LT(player::compare_images(draw("z.tvg" + shape), y, 24).far_share, 0.01) << "as the metadata say";
  const Margins lying = margins(draw("z.tvg --up X --front=-Y" + shape));
  EXPECT_LE(lying.left, 6) << "the option goes before the metadata";
  EXPECT_GE(lying.top, 20);
  EXPECT_EQ(margins(draw("y.obj --front X" + shape)).left, 96) << "a board from its edge is nothing";
  EXPECT_LT(margins(draw("y.obj --front=-Z" + shape)).top, 6);
}

TEST_F(Framing, ShowsAxesInTheCorner) {
  const std::string command = "hand.obj hand.pc2 --frames 4 --size 400x300 --camera front ";
  const player::Image without = draw(command), with = draw(command + "--axes");
  ASSERT_EQ(with.width, without.width);
  std::array<bool, 3> found{};  // red x, green y, and blue z, which looks at the viewer
  for (int row = 0; row < with.height; ++row) {
    for (int column = 0; column < with.width; ++column) {
      const std::uint8_t* const at = with.pixel(column, row);
      if (std::equal(at, at + 3, without.pixel(column, row))) continue;
      EXPECT_TRUE(column >= 300 && row >= 200) << column << " " << row << ": only the corner changes";
      for (std::size_t k = 0; k < 3; ++k)
        found[k] = found[k] || (at[k] > 130 && at[(k + 1) % 3] < 115 && at[(k + 2) % 3] < 115);
    }
  }
  EXPECT_TRUE(found[0] && found[1] && found[2]) << found[0] << found[1] << found[2];
  EXPECT_NE(draw(command + "--axes --no-labels").pixels, with.pixels) << "letters are labels";
}

TEST_F(Framing, RefusesAxesThatAreNone) {
  expect_failure("tvg render hand.obj -o a.png --up sideways", 1, "+Z");
  expect_failure("tvg render hand.obj -o a.png --front Q", 1, "+Z");
  expect_failure("tvg render hand.obj -o a.png --front=-Y", 1, "--front -Y");
  expect_failure("tvg render hand.obj -o a.png --up Z --front Z", 1, "--up");
}

}  // namespace
}  // namespace tvg::cli::testing

#endif
