#include "play_test_fixture.hpp"

#ifdef TVG_HAS_PLAYER
#include "player/view/image.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

TEST_F(PlayTest, AFilePlaysToItsEnd) {
  const Outcome result =
      on_display("tvg play hand.tvg --once --seconds 3 --size 320x240 --report report.json");
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json figures = report();
  EXPECT_TRUE(figures["first_frame_seconds"].is_number()) << figures;
  // A machine that is busy shows fewer frames, but none twice.
  EXPECT_GE(figures["frames_shown"], 2);
  EXPECT_EQ(figures["frames_shown"].get<int>() + figures["dropped"].get<int>(), 12) << figures;
  EXPECT_EQ(figures["damaged_places"], 0);
}

TEST_F(PlayTest, ABasisPlaysToItsEnd) {
  good("tvg encode hand.obj hand.pc2 -q -o basis.tvg --mode basis --period 8 --gop 4");
  const Outcome result =
      on_display("tvg play basis.tvg --once --seconds 3 --size 320x240 --report report.json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(report()["frames_shown"].get<int>() + report()["dropped"].get<int>(), 12);
  EXPECT_EQ(report()["damaged_places"], 0);
}

TEST_F(PlayTest, AScreenshotShowsMeshAndControls) {
  const Outcome result = on_display(
      "tvg play hand.tvg --start 5 --overlay importance --size 640x400 --screenshot shot.png --report "
      "report.json");
  ASSERT_EQ(result.status, 0) << result.err;
  const player::Image shot = player::read_png(folder_.path("shot.png"));
  ASSERT_EQ(shot.width, 640);
  ASSERT_EQ(shot.height, 400);
  const auto differs = [&shot](int column, int row, int other_column, int other_row) {
    return !std::equal(shot.pixel(column, row), shot.pixel(column, row) + 3,
                       shot.pixel(other_column, other_row));
  };
  // What is drawn makes a row lively; the background changes from row to row only.
  int lively = 0;
  for (int column = 1; column < 640; ++column) lively += differs(column, 170, column - 1, 170) ? 1 : 0;
  EXPECT_GT(lively, 20) << "no mesh in the middle";
  EXPECT_TRUE(differs(320, 380, 2, 380)) << "no controls at the bottom";
}

TEST_F(PlayTest, TheCostIsOfTheMeasureAskedFor) {
  const auto shoot = [this](const std::string& options) {
    const Outcome result = on_display(
        "tvg play hand.tvg --start 5 --overlay cost --size 640x400 --screenshot "
        "shot.png " +
        options);
    EXPECT_EQ(result.status, 0) << result.err;
    player::Image shot = player::read_png(folder_.path("shot.png"));
    // The panels tell times, which differ: what is compared is the mesh in the middle.
    std::fill_n(shot.pixels.begin(), std::size_t{4} * 640 * 220, std::uint8_t{0});
    std::fill(shot.pixels.begin() + std::ptrdiff_t{4} * 640 * 300, shot.pixels.end(), std::uint8_t{0});
    return shot;
  };
  const player::Image curv = shoot("");
  EXPECT_EQ(player::compare_images(curv, shoot("--measure curv"), 24).far_share, 0);
  EXPECT_GT(player::compare_images(curv, shoot("--measure velocity"), 24).far_share, 0.005);
}

TEST_F(PlayTest, AStreamPlaysOverHttpWhileItIsServed) {
  const Outcome result = on_display(
      "serve; tvg play ${U}hand.tvg --once --seconds 3 --size 320x240 --report report.json; R=$?; kill $S; "
      "wait $S; "
      "(exit $R)");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(report()["frames_shown"].get<int>() + report()["dropped"].get<int>(), 12) << report();
  EXPECT_EQ(report()["bytes_received"], folder_.read("hand.tvg").size());
}

TEST_F(PlayTest, ALiveStreamPlays) {
  const Outcome result = on_display(
      "serve; tvg encode hand.obj hand.pc2 --live --loop --gop 3 --fps 60 -q -o ${U}live/cam & E=$!; "
      "for i in $(seq 10); do "  // until the stream has begun
      "tvg play $(cat url)live/cam --seconds 2 --size 320x240 --report report.json; R=$?; [ $R = 0 ] && "
      "break; "
      "sleep 0.1; done; kill $E $S; wait $E $S; (exit $R)");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_GE(report()["frames_shown"], 2) << report();
}

TEST_F(PlayTest, DamageIsCountedAndPlayingGoesOn) {
  flip_byte("hand.tvg", chunks("hand.tvg", "GOP ").at(1).first + 40);
  const Outcome result =
      on_display("tvg play hand.tvg --once --seconds 3 --size 320x240 --report report.json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_GE(report()["damaged_places"], 1) << report();
  EXPECT_GE(report()["frames_shown"], 2) << report();
}

TEST_F(PlayTest, WhatCannotBePlayedEndsWithAMessage) {
  expect_failure("env -u DISPLAY -u WAYLAND_DISPLAY tvg play hand.tvg", 4, "tvg render");
  expect_failure("tvg play gone.tvg", 2, "gone.tvg");
  expect_failure("tvg play hand.tvg --overlay error", 1, "--ref");
  expect_failure("tvg play hand.tvg --speed 100", 1, "--speed");
  expect_failure("tvg play hand.tvg --overlay cost --measure skel", 1, "--skeleton");
  const Outcome foreign = on_display("tvg play hand.obj --seconds 1.5 --size 320x240");
  EXPECT_EQ(foreign.status, 3);
  EXPECT_THAT(foreign.err, HasSubstr("hand.obj"));
  EXPECT_THAT(foreign.err, HasSubstr("signature is missing"));
}

}  // namespace
}  // namespace tvg::cli::testing
#endif
