#include "play_test_fixture.hpp"

#if defined(TVG_HAS_PLAYER) && defined(TVG_X_CLIENT)
#include "player/view/image.hpp"

#include <filesystem>

namespace tvg::cli::testing {
namespace {

/// A window and the rest of a desktop: a file manager, a browser, a clipboard, a keyboard.
class PlayDesktop : public PlayTest {
 protected:
  /// Plays `what` while another client does `actions` to the window, and gives the report.
  nlohmann::json play_while(const std::string& what, const std::string& actions) const {
    const std::string client = "desktop() { '" + std::string(TVG_X_CLIENT) + "' tvg \"$@\"; }; ";
    const Outcome result =
        on_display(client + "serve; tvg play " + what +
                   " --once --size 320x240 --seconds 25 --report report.json & P=$!; " + actions +
                   "; R=$?; sleep 1; desktop press q; wait $P || R=$?; kill $S; wait $S; (exit $R)");
    EXPECT_EQ(result.status, 0) << result.err;
    return report();
  }

  /// As saved by F12.
  player::Image saved(int number) const {
    return player::read_png(folder_.path("tvg-00" + std::to_string(number) + ".png"));
  }

  static std::string press(const std::string& keys) {
    return "desktop press " + keys + " && sleep 0.5 && desktop press F12 && sleep 0.5";
  }
};

TEST_F(PlayDesktop, AFileThatIsDroppedPlays) {
  const nlohmann::json figures = play_while("", R"(desktop drop "file://$PWD/hand.tvg"$'\r\n')");
  EXPECT_TRUE(figures["stream"].get<std::string>().ends_with("/hand.tvg")) << figures;
  EXPECT_GE(figures["frames_shown"], 2) << figures;
}

TEST_F(PlayDesktop, AFileThatIsDroppedTakesThePlaceOfWhatPlays) {
  good("cp hand.tvg 'another hand.tvg'");
  const nlohmann::json figures =
      play_while("hand.tvg", R"(desktop drop "file://localhost$PWD/another%20hand.tvg"$'\r\n')");
  EXPECT_TRUE(figures["stream"].get<std::string>().ends_with("/another hand.tvg")) << figures;
}

TEST_F(PlayDesktop, ALinkThatIsDroppedPlays) {
  const nlohmann::json figures = play_while("", R"(desktop drop "${U}hand.tvg"$'\r\n')");
  EXPECT_TRUE(figures["stream"].get<std::string>().starts_with("http://")) << figures;
  EXPECT_GE(figures["frames_shown"], 2) << figures;
}

TEST_F(PlayDesktop, AUrlThatIsPastedPlays) {
  const nlohmann::json figures = play_while("", R"(desktop paste "  ${U}hand.tvg"$'\n')");
  EXPECT_TRUE(figures["stream"].get<std::string>().starts_with("http://")) << figures;
  EXPECT_GE(figures["frames_shown"], 2) << figures;
}

TEST_F(PlayDesktop, APathThatIsPastedPlaysAlsoAsAFilesUri) {
  EXPECT_EQ(play_while("", R"(desktop paste hand.tvg)")["stream"], "hand.tvg");
  good("cp hand.tvg 'a b.tvg'");
  const nlohmann::json figures = play_while("", R"(desktop paste "file://$PWD/a%20b.tvg")");
  EXPECT_TRUE(figures["stream"].get<std::string>().ends_with("/a b.tvg")) << figures;
}

TEST_F(PlayDesktop, WhatIsPastedAndIsNotThereLeavesWhatPlays) {
  const nlohmann::json figures = play_while("hand.tvg", "desktop paste gone.tvg && desktop paste ' '");
  EXPECT_EQ(figures["stream"], "hand.tvg");
  EXPECT_GE(figures["frames_shown"], 2) << figures;
}

TEST_F(PlayDesktop, KeysShowAxesAndTakeColoursAway) {
  folder_.write("square.obj", "v 0 0 0 0 0 1\nv 1 0 0 0 0 1\nv 1 1 0 0 0 1\nv 0 1 0 0 0 1\nf 1 2 3 4\n");
  good("tvg encode square.obj -o square.tvg -q");
  play_while("square.tvg --camera front", press("u") + " && " + press("x") + " && " + press("c"));
  const player::Image bare = saved(1), axes = saved(2), plain = saved(3);
  const auto colour_at = [](const player::Image& image, int column, int row) {
    const std::uint8_t* const at = image.pixel(column, row);
    return std::max_element(at, at + 3) - at;
  };
  EXPECT_GT(player::compare_images(bare, axes, 24).far_share, 0.002) << "x shows axes";
  EXPECT_EQ(colour_at(axes, 160, 100), 2) << "blue vertices";
  EXPECT_EQ(colour_at(plain, 160, 100), 0) << "c takes the colours away";
  bool red = false, green = false;
  for (int row = 140; row < axes.height; ++row) {
    for (int column = 220; column < axes.width; ++column) {
      const std::uint8_t* const at = axes.pixel(column, row);
      red = red || (at[0] > 180 && at[1] < 90 && at[2] < 100);
      green = green || (at[1] > 130 && at[0] < 110 && at[2] < 90);
    }
  }
  EXPECT_TRUE(red && green) << "x and y in the lower right corner";
}

}  // namespace
}  // namespace tvg::cli::testing
#endif
