#include "tests/importers/gltf_builder.hpp"
#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A user who has several machines: `hand` has 12 frames, here in GOPs of 3.
class PartsTest : public ToolTest {
 protected:
  /// What is encoded whole, and in parts, with these inputs and options is the same.
  void expect_same(const std::string& encoding, int parts) const {
    good("rm -rf p && mkdir p && tvg encode " + encoding + " -o whole.tvg");
    good("tvg plan " + encoding + " -o p/x.plan.json --parts " + std::to_string(parts));
    good("tvg encode --plan p/x.plan.json && tvg join --plan p/x.plan.json");
    good("cmp whole.tvg p/x.tvg");
  }

  void plan_four() const { good("tvg plan hand.obj hand.pc2 --gop 3 --parts 4"); }
};

TEST_F(PartsTest, JoinToTheVeryBytesOfOneMachine) {
  for (const char* const options :
       {"", "--bits 13:11 --important 35%", "--bits 13:11 --lookahead 0", "--mode basis --period 4",
        "--predictor pyramid --lod 1", "--lossless", "--step 0.001 --frames 2-10", "--max-error 0.1%",
        "--reorder --fps 24 --name 'a name' --meta 'note=x=y'"}) {
    expect_same(std::string("hand.obj hand.pc2 --gop 3 ") + options, 3);
  }
}

TEST_F(PartsTest, OfFilesThatChangeJoinToTheVeryBytesOfOneMachine) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\n";
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0.25\nf 1 2 3\n";
  const std::vector<std::string> files = {square + "f 1 2 3\nf 1 3 4\n",
                                          square + "f 1 2 3\nf 1 3 4\n",
                                          triangle,
                                          square + "f 3 4 1\nf 2 3 1\n",
                                          square + "f 1 2 3\nf 1 3 4\n",
                                          "# nothing\n",
                                          triangle,
                                          square + "f 3 4 1\nf 2 3 1\n"};
  for (std::size_t i = 0; i < files.size(); ++i) folder_.write("s/f" + std::to_string(i) + ".obj", files[i]);
  for (int parts = 1; parts < 7; ++parts) {
    expect_same("s --gop 1", parts);
    expect_same("s --gop 2 --predictor pyramid", parts);
  }
}

TEST_F(PartsTest, OfAttributesThatChangeAndOfAScenesJointsJoinToTheVeryBytesOfOneMachine) {
  for (int i = 0; i < 7; ++i) {
    const std::string u = std::to_string(0.1 * i);
    folder_.write("u/f" + std::to_string(i) + ".obj",
                  "v 0 0 " + u + "\nv 1 0 0\nv 1 1 0\nvt " + u + " 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n");
  }
  expect_same("u --gop 2", 3);
  GltfBuilder gltf;
  nlohmann::json primitive =
      gltf.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  gltf.json["meshes"] = {{{"name", "Block"}, {"primitives", {primitive}}}};
  gltf.json["nodes"] = {{{"name", "BlockNode"}, {"mesh", 0}}};
  gltf.animate(0, 0, "translation", {0, 1}, "VEC3", {0, 0, 0, 4, 0, 0});
  set_roots(gltf, {0});
  folder_.write("block.gltf", gltf.text());
  expect_same("block.gltf --fps 20 --gop 4 --skeleton-data", 4);
}

TEST_F(PartsTest, AreNamedAfterThePlanAndFoundBesideIt) {
  good("mkdir far && tvg plan hand.obj hand.pc2 --gop 3 --parts 4 -o far/shot.plan.json");
  good("tvg encode --plan far/shot.plan.json --part 2");
  EXPECT_TRUE(std::filesystem::exists(folder_.path("far/shot.part-2-of-4.tvg")));
  good("mv far near && tvg encode --plan near/shot.plan.json --part 1");
  const auto info = json("tvg info near/shot.part-2-of-4.tvg --json");
  EXPECT_EQ(info["frames"], 3);
  good("tvg verify near/shot.part-2-of-4.tvg");
}

TEST_F(PartsTest, ThatAreThereAndWholeAreNotMadeAgain) {
  plan_four();
  good("tvg encode --plan hand.plan.json && stat -c %Y.%i hand.part-* > before");
  EXPECT_THAT(run("tvg encode --plan hand.plan.json --part 2").err,
              HasSubstr("part 2 of 4 (frames 3-5) is there and whole"));
  flip_byte("hand.part-3-of-4.tvg", 500);
  good("head -c 300 hand.part-4-of-4.tvg > cut && mv cut hand.part-4-of-4.tvg");
  const std::string said = good("tvg encode --plan hand.plan.json").err;
  EXPECT_THAT(said, HasSubstr("part 1 of 4 (frames 0-2) is there"));
  EXPECT_THAT(said, Not(HasSubstr("part 3 of 4 (frames 6-8) is there")));
  good(
      "tvg join --plan hand.plan.json && tvg encode hand.obj hand.pc2 --gop 3 -o one.tvg && cmp hand.tvg "
      "one.tvg");
  good("tvg plan hand.obj hand.pc2 --gop 3 --bits 9 --parts 4");
  EXPECT_THAT(run("tvg encode --plan hand.plan.json --part 1").err, Not(HasSubstr("is there")))
      << "parts of the plan before are no parts of this one";
}

TEST_F(PartsTest, ThatAreMissingOrOfAnotherPlanAreNamed) {
  plan_four();
  good("tvg encode --plan hand.plan.json --part 1 && tvg encode --plan hand.plan.json --part 3");
  expect_failure("tvg join --plan hand.plan.json", 3, "2 of 4 parts are missing: 2, 4; tvg encode --plan");
  expect_failure("tvg join hand.part-1-of-4.tvg hand.part-3-of-4.tvg -o x.tvg", 1, "part 2 of 4 is missing");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("hand.tvg")));
  good("tvg encode --plan hand.plan.json");
  good("tvg plan hand.obj hand.pc2 --gop 3 --bits 9 --parts 4");
  expect_failure("tvg join --plan hand.plan.json", 3, "made by a plan that was there before");
}

TEST_F(PartsTest, ThatFailNameThemselves) {
  plan_four();
  good("head -c 40000 hand.pc2 > cut && mv cut hand.pc2");
  expect_failure("tvg encode --plan hand.plan.json --part 4", 3, "part 4 of 4 (frames 9-11): ");
  folder_.write("hand.plan.json", "{}");
  expect_failure("tvg encode --plan hand.plan.json --part 4", 3, "this is no plan");
  folder_.write("hand.plan.json", "v 0 0 0");
  expect_failure("tvg join --plan hand.plan.json", 3, "this is no plan");
  expect_failure("tvg encode --plan none.json", 2, "none.json: No such file");
}

TEST_F(PartsTest, TakeNoOtherOptionsThanThePlans) {
  plan_four();
  expect_failure("tvg encode --plan hand.plan.json --bits 9", 1, "--bits: not with --plan");
  expect_failure("tvg encode hand.obj hand.pc2 --plan hand.plan.json", 1, "input: not with --plan");
  expect_failure("tvg encode --plan hand.plan.json --part 5", 1, "has the parts 1 to 4");
  expect_failure("tvg encode --plan hand.plan.json -o x.tvg", 1, "say which --part");
  expect_failure("tvg encode hand.obj --part 2", 1, "--plan");
  expect_failure("tvg encode", 1, "input is required");
  expect_failure("tvg join -o x.tvg", 1, "input is required");
  expect_failure("cat hand.pc2 | tvg plan hand.obj - --parts 2 -o x.json", 1, "only once");
}

TEST_F(PartsTest, AreAsManyAsThereAreThingsToEncodeTogether) {
  EXPECT_THAT(good("tvg plan hand.obj hand.pc2 --gop 5 --parts 9").err,
              HasSubstr("3 parts where 9 were asked for: 5 frames are encoded together (--gop)"));
  const auto planned = json("tvg plan hand.obj hand.pc2 --mode basis --period all --parts 9 --json -q");
  EXPECT_EQ(planned["parts"], 1);
  EXPECT_EQ(planned["frames"], 12);
}

}  // namespace
}  // namespace tvg::cli::testing
