#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class JoinTest : public ToolTest {
 protected:
  JoinTest() {
    good(
        "tvg encode hand.obj hand.pc2 -o whole.tvg --gop 3 --step 0.002 && tvg decode whole.tvg -o "
        "whole.pc2");
    good("tvg encode hand.obj hand.pc2 -o a.tvg --gop 3 --step 0.002 --frames 0-5");
    good("tvg encode hand.obj hand.pc2 -o b.tvg --gop 3 --step 0.002 --frames 6-11");
  }

  /// The bytes of each GOP of a stream.
  std::vector<std::string> gops(const std::string& stream) const {
    const std::string bytes = folder_.read(stream);
    std::vector<std::string> result;
    for (const auto& [offset, size] : chunks(stream, "GOP ")) result.push_back(bytes.substr(offset, size));
    return result;
  }
};

TEST_F(JoinTest, CopiesGopsByteForByteAndWritesTheMeshOnce) {
  good("tvg join a.tvg b.tvg -o joined.tvg && tvg verify joined.tvg");
  std::vector<std::string> parts = gops("a.tvg");
  for (const std::string& gop : gops("b.tvg")) parts.push_back(gop);
  EXPECT_EQ(gops("joined.tvg"), parts);
  EXPECT_EQ(chunks("joined.tvg", "MESH").size(), 1U);
}

TEST_F(JoinTest, PartsDecodeToTheirOwnFramesOneAfterTheOther) {
  good("tvg join a.tvg b.tvg -o joined.tvg");
  good("tvg decode joined.tvg -o joined.pc2 && tvg decode a.tvg -o a.pc2 && tvg decode b.tvg -o b.pc2");
  EXPECT_EQ(folder_.read("joined.pc2").substr(32),
            folder_.read("a.pc2").substr(32) + folder_.read("b.pc2").substr(32));
  EXPECT_LE(json("tvg compare hand.pc2 joined.tvg --mesh hand.obj --json")["max_coordinate_error"],
            0.001 * 1.001);
}

TEST_F(JoinTest, PartsEncodedApartByTheirStepJoinToTheWholeStream) {
  good("tvg join a.tvg b.tvg -o joined.tvg && cmp joined.tvg whole.tvg");
}

TEST_F(JoinTest, CutPartsJoinToTheWholeStreamAgain) {
  good("tvg join whole.tvg --frames 0-5 -o front.tvg && tvg join whole.tvg --frames 6-11 -o rear.tvg");
  EXPECT_EQ(json("tvg info front.tvg --json")["frames"], 6);
  good("tvg join front.tvg rear.tvg -o again.tvg && cmp again.tvg whole.tvg");
  good("tvg join a.tvg b.tvg whole.tvg --frames 3-20 -o middle.tvg && tvg verify middle.tvg");
  EXPECT_EQ(json("tvg info middle.tvg --json")["frames"], 18);
}

TEST_F(JoinTest, CutsAwayFromGopBordersNameTheNearestBorders) {
  expect_failure("tvg join whole.tvg --frames 4-8 -o no.tvg", 1, "begin at frame 3, or at 6");
  expect_failure("tvg join whole.tvg --frames 3-7 -o no.tvg", 1, "end at frame 5 or 8");
  expect_failure("tvg join whole.tvg --frames 0-1 -o no.tvg", 1, "end at frame 2");
  expect_failure("tvg join whole.tvg --frames 3-14 -o no.tvg", 1, "has the frames 0-11");
  expect_failure("tvg join whole.tvg --frames 8-3 -o no.tvg", 1, "0-49");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("no.tvg")));
}

TEST_F(JoinTest, OtherConnectivityAndOptionsJoinToo) {
  const Sequence cloth = corpus::find_corpus_entry("cloth")->make({200, 4}).sequence;
  corpus::write_obj(folder_.path("cloth.obj"), cloth);
  corpus::write_pc2(folder_.path("cloth.pc2"), cloth);
  good("tvg encode cloth.obj cloth.pc2 -o cloth.tvg --bits 13:9 --predictor time --gop 2");
  good("tvg join a.tvg cloth.tvg b.tvg -o joined.tvg && tvg verify joined.tvg");
  EXPECT_EQ(chunks("joined.tvg", "MESH").size(), 3U);
  good("mkdir f && tvg decode joined.tvg -o f/%02d.ply");
  EXPECT_EQ(run("ls f | wc -l").out, "16\n");
  const auto joined = json("tvg info joined.tvg --json")["limits"];
  EXPECT_EQ(joined["vertices"], std::max(hand_.mesh.vertex_count, cloth.mesh.vertex_count));
  EXPECT_EQ(joined["frames_per_gop"], 3);
  good("tvg decode joined.tvg -o g_%02d.ply --frames 6-9 && cmp g_00.ply f/06.ply");
}

TEST_F(JoinTest, CutsInsideAPeriodTakeThePlanesAlong) {
  good("tvg encode hand.obj hand.pc2 -o basis.tvg --mode basis --period 9 --gop 3");
  good("tvg decode basis.tvg -o basis.pc2");
  const std::string frames = folder_.read("basis.pc2").substr(32);
  const std::size_t frame = frames.size() / kFrames;
  good("tvg join basis.tvg --frames 3-8 -o middle.tvg && tvg verify -q middle.tvg");
  EXPECT_EQ(chunks("middle.tvg", "PLAN").size(), 1U);
  good("tvg decode middle.tvg -o middle.pc2");
  EXPECT_EQ(folder_.read("middle.pc2").substr(32), frames.substr(3 * frame, 6 * frame));
  good("tvg join basis.tvg --frames 0-2 -o front.tvg && tvg join basis.tvg --frames 3-11 -o rear.tvg");
  good("tvg join front.tvg rear.tvg -o again.tvg && tvg verify -q again.tvg");
  good("tvg decode again.tvg -o again.pc2 && cmp again.pc2 basis.pc2");
  expect_failure("tvg join basis.tvg --frames 1-5 -o no.tvg", 1, "begin at frame 0, or at 3");
}

TEST_F(JoinTest, StreamsOfOtherModesFollowOneAnother) {
  good("tvg encode hand.obj hand.pc2 -o x.tvg --mode basis --period 6 --gop 3 --frames 0-5");
  good("tvg encode hand.obj hand.pc2 -o y.tvg --mode basis --bits 13 --period 3 --gop 3 --frames 6-11");
  good("tvg encode hand.obj hand.pc2 -o z.tvg --lossless --gop 4");
  good("tvg join x.tvg y.tvg a.tvg z.tvg x.tvg -o joined.tvg && tvg verify -q joined.tvg");
  good("mkdir f && tvg decode joined.tvg -o f/joined_%02d.ply");
  int next = 0;
  for (const char* const part : {"x", "y", "a", "z", "x"}) {
    good(std::string("rm -f g_*; tvg decode ") + part + ".tvg -o g_%02d.ply");
    const int count = json(std::string("tvg info ") + part + ".tvg --json")["frames"];
    for (int i = 0; i < count; ++i, ++next)
      good("cmp $(printf 'g_%02d.ply' " + std::to_string(i) + ") $(printf 'f/joined_%02d.ply' " +
           std::to_string(next) + ")");
  }
  EXPECT_EQ(json("tvg info joined.tvg --json")["frames"], next);
}

TEST_F(JoinTest, MetadataOfTheFirstAreKeptAndDifferencesNoted) {
  good("tvg encode hand.obj hand.pc2 -o one.tvg --fps 30 --name one");
  good("tvg encode hand.obj hand.pc2 -o two.tvg --fps 25 --units cm --name one");
  const Outcome joined = good("tvg join one.tvg two.tvg -o both.tvg");
  EXPECT_THAT(joined.err, HasSubstr("two.tvg: its fps is \"25\""));
  EXPECT_THAT(joined.err, Not(HasSubstr("its name")));
  const auto metadata = json("tvg info both.tvg --json")["metadata"];
  EXPECT_EQ(metadata["fps"], "30");
  EXPECT_EQ(metadata["units"], "cm");
}

TEST_F(JoinTest, DamagedInputsAreNamedWithThePlaceAndLeaveNothing) {
  const std::string whole = folder_.read("b.tvg");
  const std::vector<std::string> before = folder_.names();
  for (std::size_t offset = 0; offset < whole.size(); offset += 1 + whole.size() / 60) {
    flip_byte("b.tvg", offset);
    const Outcome result = run("tvg join a.tvg b.tvg -o no.tvg");
    EXPECT_EQ(result.status, 3) << "byte " << offset;
    EXPECT_THAT(result.err, HasSubstr("tvg: b.tvg: ")) << "byte " << offset;
    EXPECT_THAT(result.err, HasSubstr("byte ")) << "byte " << offset;
    EXPECT_EQ(folder_.names(), before) << "byte " << offset;
    folder_.write("b.tvg", whole);
  }
  folder_.write("b.tvg", whole + "x");
  expect_failure("tvg join a.tvg b.tvg -o no.tvg", 3, "bytes follow the stream's tail");
}

TEST_F(JoinTest, AnInputMayComeThroughAPipe) {
  good("cat b.tvg | tvg join whole.tvg - -o - | tvg verify -");
  expect_failure("tvg join - - -o no.tvg", 1, "once");
}

}  // namespace
}  // namespace tvg::cli::testing
