#include "tests/cli/tool_test_fixture.hpp"

#ifdef TVG_HAS_PLAYER

#include "player/view/image.hpp"

#include <algorithm>

namespace tvg::cli::testing {
namespace {

namespace fs = std::filesystem;

/// `tvg render` as a user types it. Small pictures: a software renderer draws them.
class Render : public ToolTest {
 protected:
  Render() { good("tvg encode hand.obj hand.pc2 -o hand.tvg --bits 12:9 --important 35% --gop 5 -q"); }

  void SetUp() override {
    const Outcome outcome = run("tvg render hand.tvg -o probe.png --frames 0 --size 32x32 -q");
    if (outcome.err.find("cannot draw without a display") != std::string::npos) GTEST_SKIP() << outcome.err;
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    fs::remove(folder_.path("probe.png"));
  }

  /// Names of files with this suffix, sorted.
  std::vector<std::string> files(const std::string& suffix) const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path(""))) {
      if (entry.path().extension() == suffix) names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  bool nothing_unfinished() const {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path(""))) {
      if (entry.path().filename().string().find(".tmp") != std::string::npos) return false;
    }
    return true;
  }

  player::Image picture(const std::string& name) const { return player::read_png(folder_.path(name)); }
};

TEST_F(Render, NumbersPicturesAsFramesAre) {
  good("tvg render hand.tvg -o out_%03d.png --frames 3-6 --size 64x48 -q");
  EXPECT_EQ(files(".png"),
            (std::vector<std::string>{"out_003.png", "out_004.png", "out_005.png", "out_006.png"}));
  EXPECT_EQ(picture("out_003.png").width, 64);
  EXPECT_EQ(picture("out_003.png").height, 48);
  EXPECT_NE(picture("out_003.png").pixels, picture("out_006.png").pixels);
}

TEST_F(Render, DrawsTheSameFromAStreamAndFromWhatItDecodesTo) {
  good("tvg decode hand.tvg -o back.pc2 -q");
  good("tvg render hand.tvg -o a.png --frames 7 --size 96x72 -q");
  good("tvg render back.obj back.pc2 -o b.png --frames 7 --size 96x72 -q");
  EXPECT_EQ(picture("a.png").pixels, picture("b.png").pixels);
}

TEST_F(Render, DrawsABasisAsWhatItDecodesTo) {
  good("tvg encode hand.obj hand.pc2 -o basis.tvg --mode basis --period 6 --gop 3 -q");
  good("tvg decode basis.tvg -o back.pc2 -q");
  good("tvg render basis.tvg -o a.png --frames 10 --size 96x72 -q");
  good("tvg render back.obj back.pc2 -o b.png --frames 10 --size 96x72 -q");
  EXPECT_EQ(picture("a.png").pixels, picture("b.png").pixels);
}

TEST_F(Render, DrawsWhatComesThroughAPipe) {
  good("cat hand.tvg | tvg render - -o piped_####.png --frames 3-5 --size 96x72 -q");
  EXPECT_EQ(files(".png"), (std::vector<std::string>{"piped_0003.png", "piped_0004.png", "piped_0005.png"}));
}

TEST_F(Render, DrawsAFileThatTheShellRedirects) {
  good("tvg render - -o redirected.png --frames 3-5 --size 96x72 -q <hand.tvg");
  good("tvg render hand.tvg -o named.png --frames 3-5 --size 96x72 -q");
  EXPECT_EQ(picture("redirected.png").pixels, picture("named.png").pixels);
}

TEST_F(Render, DrawsFilesWhoseMeshChangesAndFramesThatShowNothing) {
  folder_.write("a_0.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder_.write("a_1.obj", "# nothing\n");
  folder_.write("a_2.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  good("tvg encode a_0.obj a_1.obj a_2.obj -o a.tvg -q");
  good("tvg render a_0.obj a_1.obj a_2.obj -o src_%d.png --size 64x48 --camera front -q");
  good("tvg render a.tvg -o tvg_%d.png --size 64x48 --camera front -q");
  for (const std::string number : {"0", "1", "2"}) {
    const player::Image source = picture("src_" + number + ".png"),
                        stream = picture("tvg_" + number + ".png");
    EXPECT_LT(player::compare_images(source, stream, 24).mean, 1) << number;
    const std::uint8_t* const middle = source.pixel(40, 30);
    EXPECT_EQ(middle[0] > middle[2] + 20, number == "2") << number << ": clay, or the background";
  }
}

/// A square whose left half has a red and whose right half a green material, and another with a texture.
TEST_F(Render, DrawsMaterialsTexturesAndColours) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0 0\nv 0.5 1 0\n";
  folder_.write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl picture\nmap_Kd half.png\n");
  folder_.write("m.obj", "mtllib m.mtl\n" + square + "usemtl red\nf 1 5 6 4\nusemtl none\nf 5 2 3 6\n");
  folder_.write("t.obj", "mtllib m.mtl\n" + square +
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl picture\nf 1/1 2/2 3/3 4/4\n");
  player::Image half{8, 8, std::vector<std::uint8_t>(256, 255)};  // blue above, green below
  for (std::size_t i = 0; i < 64; ++i) {
    half.pixels[4 * i] = 0;
    half.pixels[4 * i + (i < 32 ? 1 : 2)] = 0;
  }
  player::write_png(folder_.path("half.png"), half);
  folder_.write("c.obj", "v 0 0 0 0 0 1\nv 1 0 0 0 0 1\nv 1 1 0 0 0 1\nv 0 1 0 0 0 1\nf 1 2 3 4\n");
  const auto strongest = [](const player::Image& image, int column, int row) {
    const std::uint8_t* const at = image.pixel(column, row);
    return std::max_element(at, at + 3) - at;
  };
  for (const char* const name : {"m", "t", "c"}) {
    const std::string file(name);
    good("tvg encode " + file + ".obj -o " + file + ".tvg -q");
    good("tvg render " + file + ".tvg -o " + file + "_tvg.png --size 64x64 --camera front -q");
    good("tvg render " + file + ".obj -o " + file + "_obj.png --size 64x64 --camera front -q");
    EXPECT_LT(player::compare_images(picture(file + "_tvg.png"), picture(file + "_obj.png"), 24).mean, 1);
  }
  EXPECT_EQ(strongest(picture("m_tvg.png"), 20, 32), 0);
  EXPECT_LT(picture("m_tvg.png").pixel(20, 32)[1], 110) << "red, and not clay";
  EXPECT_EQ(strongest(picture("t_tvg.png"), 32, 16), 2) << "the picture's upper half is above";
  EXPECT_EQ(strongest(picture("t_tvg.png"), 32, 48), 1);
  EXPECT_EQ(strongest(picture("c_tvg.png"), 32, 32), 2);
  good("tvg render c.tvg -o plain.png --size 64x64 --camera front --plain -q");
  EXPECT_EQ(strongest(picture("plain.png"), 32, 32), 0);
  fs::remove(folder_.path("half.png"));
  const Outcome without = run("tvg render t.tvg -o without.png --size 64x64");
  EXPECT_EQ(without.status, 0);
  EXPECT_NE(without.err.find("texture half.png: not there"), std::string::npos) << without.err;
}

TEST_F(Render, DrawsTheColoursThatEachFrameHas) {
  const std::array<std::string, 3> rgb = {" 1 0 0", " 0 1 0", " 0 0 1"};
  for (std::size_t frame = 0; frame < 3; ++frame) {
    std::string text;
    for (const char* const corner : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"})
      text += "v " + std::string(corner) + rgb[frame] + "\n";
    folder_.write("c_" + std::to_string(frame) + ".obj", text + "f 1 2 3 4\n");
  }
  good("tvg encode c_0.obj c_1.obj c_2.obj -o c.tvg -q");
  good("tvg render c.tvg -o tvg_%d.png --size 64x64 --camera front -q");
  good("tvg render c_0.obj c_1.obj c_2.obj -o obj_%d.png --size 64x64 --camera front -q");
  for (std::ptrdiff_t frame = 0; frame < 3; ++frame) {
    for (const std::string kind : {"tvg_", "obj_"}) {
      const player::Image drawn = picture(kind + std::to_string(frame) + ".png");
      const std::uint8_t* const middle = drawn.pixel(32, 32);
      EXPECT_EQ(std::max_element(middle, middle + 3) - middle, frame) << kind;
      EXPECT_LT(*std::min_element(middle, middle + 3), 110) << kind << frame << ": a colour, and not clay";
    }
  }
}

TEST_F(Render, MakesOneSheetOfSeveralFrames) {
  good("tvg render hand.tvg -o sheet.png --size 320x240 -q");
  good("tvg render hand.tvg -o sheet2.png --size 320x240 --sheet 2x1 -q");
  EXPECT_EQ(files(".png"), (std::vector<std::string>{"sheet.png", "sheet2.png"}));
  EXPECT_EQ(picture("sheet.png").width, 320);
  EXPECT_EQ(picture("sheet.png").height, 240);
  EXPECT_NE(picture("sheet.png").pixels, picture("sheet2.png").pixels);
}

TEST_F(Render, DrawsEveryOverlay) {
  good("tvg render hand.tvg -o none.png --frames 6 --size 96x72 --no-labels -q");
  const player::Image plain = picture("none.png");
  for (const std::string overlay : {"importance", "cost", "error --ref hand.obj hand.pc2"}) {
    good("tvg render hand.tvg -o overlay.png --frames 6 --size 96x72 --no-labels -q --overlay " + overlay);
    EXPECT_GT(player::compare_images(plain, picture("overlay.png"), 24).far_share, 0.05) << overlay;
  }
}

TEST_F(Render, ShowsTheCostOfTheMeasureAskedFor) {
  corpus::write_skeleton(folder_.path("hand.skeleton.json"), corpus::make_hand({400, kFrames}).joints);
  std::string weights;
  for (std::uint32_t v = 0; v < hand_.mesh.vertex_count; ++v) weights += std::to_string(v % 7) + "\n";
  folder_.write("w.txt", weights);
  const auto draw = [this](const std::string& options) {
    good("tvg render " + options + " -o c.png --frames 6 --size 96x72 --no-labels -q --overlay cost");
    return picture("c.png");
  };
  const player::Image curv = draw("hand.tvg");
  EXPECT_EQ(draw("hand.tvg --measure curv").pixels, curv.pixels);
  for (const std::string options :
       {"--measure velocity", "--alpha 1", "--smooth 4", "--measure weights --weights w.txt",
        "--measure=-distance --viewpoint 0,5,-30", "--measure skel --skeleton hand.skeleton.json"}) {
    EXPECT_GT(player::compare_images(curv, draw("hand.tvg " + options), 24).far_share, 0.01) << options;
  }
  good("tvg decode hand.tvg -o back.pc2 -q");
  const std::string skel = " --measure curv+skel --skeleton hand.skeleton.json";
  good("tvg encode back.obj back.pc2 -o whole.tvg --bits 20 -q");
  EXPECT_LT(player::compare_images(draw("whole.tvg" + skel), draw("back.obj back.pc2" + skel), 24).far_share,
            0.005)
      << "a stream's joints are those of its frames";
}

TEST_F(Render, SaysWhichMeasureItShows) {
  const auto draw = [this](const std::string& options) {
    good("tvg render hand.tvg -o c.png --frames 6 --size 384x288 -q --overlay cost " + options);
    return picture("c.png");
  };
  EXPECT_NE(draw("").pixels, draw("--alpha 0.5").pixels) << "the default is called so, and nothing else";
}

TEST_F(Render, RefusesAMeasureThatCannotBeShown) {
  const std::string cost = "tvg render hand.tvg -o a.png --frames 6 --size 96x72 --overlay cost ";
  expect_failure("tvg render hand.tvg -o a.png --measure velocity", 1, "--overlay cost");
  expect_failure("tvg render hand.tvg -o a.png --overlay importance --smooth 2", 1, "--overlay cost");
  expect_failure(cost + "--measure heat", 1, "velocity");
  expect_failure(cost + "--measure skel", 1, "--skeleton");
  expect_failure(cost + "--measure velocity --alpha 1", 1, "--alpha");
  expect_failure(cost + "--measure skel --skeleton walk.bvh", 1, "JSON");
  expect_failure("tvg render hand.obj hand.pc2 -o a.png --overlay cost --measure skel", 1, "skeleton");
  folder_.write("w.txt", "1\n2\n");
  expect_failure(cost + "--measure weights --weights w.txt", 1, "vertices");
  corpus::write_skeleton(folder_.path("short.json"), corpus::make_hand({400, 3}).joints);
  expect_failure(cost + "--measure skel --skeleton short.json", 3, "ends after 3 frames");
  expect_failure("tvg render hand.tvg -o w.txt.png --overlay cost --measure weights --weights w.txt.png", 2,
                 "w.txt.png");
  EXPECT_TRUE(files(".png").empty());
}

TEST_F(Render, ShowsTheReferenceBeside) {
  good(
      "tvg render hand.tvg -o both.png --frames 6 --size 192x72 --no-labels -q --side-by-side --ref hand.obj "
      "hand.pc2");
  EXPECT_EQ(picture("both.png").width, 192);
}

TEST_F(Render, RefusesWhatDoesNotGoTogether) {
  expect_failure("tvg render hand.tvg -o a.gif", 1, "out%04d.png");
  expect_failure("tvg render hand.tvg -o a.png --size 10", 1, "1280x720");
  expect_failure("tvg render hand.tvg -o a.png --size 99999x10", 1, "1280x720");
  expect_failure("tvg render hand.tvg -o a.mp4 --size 63x48", 1, "even");
  expect_failure("tvg render hand.tvg -o a.png --camera up", 1, "iso");
  expect_failure("tvg render hand.tvg -o a.png --overlay heat", 1, "importance");
  expect_failure("tvg render hand.tvg -o a.png --overlay error", 1, "--ref");
  expect_failure("tvg render hand.tvg -o a.png --side-by-side", 1, "--ref");
  expect_failure("tvg render hand.tvg -o a.png --ref hand.obj hand.pc2", 1, "--overlay error");
  expect_failure("tvg render hand.obj hand.pc2 -o a.png --overlay importance", 1, ".tvg");
  expect_failure("tvg render hand.tvg -o a%d.png --sheet 2x2", 1, "contact sheet");
  expect_failure("tvg render hand.tvg -o a.png --sheet 0x2", 1, "4x3");
  expect_failure("tvg render hand.tvg -o a.png --fps 30", 1, "clip");
  expect_failure("tvg render hand.tvg -o a.mp4 --fps fast", 1, "30000/1001");
  expect_failure("tvg render hand.tvg -o a.png --frames 9-12", 1, "0-11");
  expect_failure("tvg render hand.tvg -o a.png --background pink", 1, "#rrggbb");
  expect_failure("tvg render hand.tvg -o a.png --shading round", 1, "flat");
  expect_failure("tvg render hand.tvg -o a.png --scale 2", 1, "--overlay");
  expect_failure("tvg render none.tvg -o a.png", 2, "none.tvg");
  expect_failure("cat hand.tvg | tvg render - -o a.png", 1, "--frames");
  EXPECT_TRUE(files(".png").empty());
  EXPECT_TRUE(nothing_unfinished());
}

TEST_F(Render, RefusesAReferenceOfAnotherMesh) {
  corpus::write_obj(folder_.path("toy.obj"), corpus::find_corpus_entry("toy")->make({1000, 1}).sequence);
  expect_failure("tvg render hand.tvg -o a.png --frames 0 --overlay error --ref toy.obj", 3, "vertices");
  expect_failure("tvg render hand.tvg -o a_%d.png --size 64x48 --side-by-side --ref toy.obj", 3,
                 "ends before");
}

TEST_F(Render, StopsAtDamageUnlessToldToConcealIt) {
  const auto gop = chunks("hand.tvg", "GOP ").at(1);
  flip_byte("hand.tvg", gop.first + gop.second / 2);
  expect_failure("tvg render hand.tvg -o a_%02d.png --size 64x48 -q", 3, "--conceal");
  EXPECT_TRUE(files(".png").empty());
  const Outcome outcome = good("tvg render hand.tvg -o a_%02d.png --size 64x48 -q --conceal");
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("lost"));
  EXPECT_EQ(files(".png").size(), 12U);
  EXPECT_EQ(picture("a_09.png").pixels, picture("a_08.png").pixels);
}

TEST_F(Render, SaysOnceWhatIsMissing) {
  const std::string stream = folder_.read("hand.tvg");
  folder_.write("cut.tvg", stream.substr(0, stream.size() / 2));
  const std::string err = good("tvg render cut.tvg -o cut.png --size 64x48 -q --conceal").err;
  const std::string what = "the stream ends before it is complete";
  ASSERT_NE(err.find(what), std::string::npos) << err;
  EXPECT_EQ(err.find(what), err.rfind(what)) << err;
}

TEST_F(Render, WritesAClip) {
  if (run("command -v ffmpeg && command -v ffprobe").status != 0) GTEST_SKIP() << "no ffmpeg here";
  good("tvg render hand.tvg -o clip.mp4 --frames 2-9 --size 64x48 --fps 24 -q");
  const Outcome probe = good(
      "ffprobe -v error -count_frames -show_entries stream=width,height,pix_fmt,r_frame_rate,nb_read_frames "
      "-of default=nw=1 clip.mp4");
  for (const char* line :
       {"width=64", "height=48", "pix_fmt=yuv420p", "r_frame_rate=24/1", "nb_read_frames=8"}) {
    EXPECT_THAT(probe.out, ::testing::HasSubstr(line));
  }
  EXPECT_TRUE(nothing_unfinished());
}

TEST_F(Render, SaysHowToGoOnWithoutFfmpeg) {
  const std::string tool = TVG_TOOL;
  expect_failure("PATH=/nowhere '" + tool + "' render hand.tvg -o clip.mp4 --size 64x48 -q", 4,
                 "out%04d.png");
  EXPECT_FALSE(fs::exists(folder_.path("clip.mp4")));
  EXPECT_TRUE(nothing_unfinished());
}

TEST_F(Render, LeavesNoClipWhereFfmpegOrTheStreamFails) {
  good(
      "mkdir hollow; printf '#!/bin/sh\\necho no codec here >&2\\nexit 3\\n' > hollow/ffmpeg; chmod +x "
      "hollow/ffmpeg");
  expect_failure(
      "PATH=hollow:/usr/bin:/bin '" + std::string(TVG_TOOL) + "' render hand.tvg -o clip.mp4 --size 64x48 -q",
      4, "no codec here");
  EXPECT_FALSE(fs::exists(folder_.path("clip.mp4")));
  EXPECT_TRUE(nothing_unfinished());
}

}  // namespace
}  // namespace tvg::cli::testing

#endif
