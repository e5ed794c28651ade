#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

/// Commands whose output would be one of their inputs.
class OverInput : public ToolTest {
 protected:
  OverInput() {
    good("tvg encode hand.obj hand.pc2 -o hand.tvg --gop 6");
    good("mkdir walk && tvg decode hand.tvg -o walk/w_%04d.ply");
    good("seq 1 400 >weights.txt");
    good("ln -s hand.pc2 soft.tvg && ln hand.pc2 hard.tvg && ln hand.tvg hand2.tvg");
  }

  /// Runs what must be refused as usage; says so, and leaves the folder as it was.
  void expect_refused(const std::string& command, const std::string& words = "an input: give the output") {
    const auto snapshot = [this] {
      return good(
                 "find . -type f -o -type l | sort | xargs ls -li --time-style=full-iso; cat $(ls -p | grep "
                 "-v /) | "
                 "cksum")
          .out;
    };
    const std::string before = snapshot();
    expect_failure(command, 1, words);
    EXPECT_EQ(snapshot(), before) << command;
  }
};

TEST_F(OverInput, EncodeNeverOverwritesWhatItReads) {
  const std::string encode = "tvg encode hand.obj hand.pc2 ";
  expect_refused(encode + "-o hand.pc2");
  expect_refused(encode + "-o ./hand.pc2");
  expect_refused(encode + "-o hand.obj");
  expect_refused(encode + "-o soft.tvg", "soft.tvg: it is the same file as hand.pc2, an input");
  expect_refused(encode + "-o hard.tvg");
  expect_refused(encode + "--bits 13:11 --measure weights --weights weights.txt -o weights.txt");
  expect_refused("tvg encode walk/w_%04d.ply -o walk/w_0003.ply");
  expect_refused("tvg encode walk -o walk/w_0003.ply");
  expect_refused("tvg encode hand.obj - <hand.pc2 -o hard.tvg", "standard input");
  good("tvg encode walk -o walk/out.tvg && tvg encode walk -o walk/out.tvg");  // no mesh: not an input
}

TEST_F(OverInput, EncodeNeverOverwritesASkeletonOrTheBufferOfAScene) {
  good("printf '{\"joints\":[{\"name\":\"a\",\"parent\":null}],\"frames\":[[[0,0,0]]]}' >joints.json");
  expect_refused("tvg encode hand.obj hand.pc2 --skeleton joints.json -o joints.json");
  good("echo '{}' >s.gltf; echo buffer >s.bin");
  expect_refused("tvg encode s.gltf -o s.bin");
  expect_refused("tvg encode s.gltf -o s.gltf");
}

TEST_F(OverInput, DecodeNeverOverwritesItsStream) {
  good("cp hand.tvg walk.tvg && ln walk.tvg back.pc2 && ln walk.tvg m.obj");
  good("ln walk.tvg seq_0003.ply && ln walk.tvg one_0002.obj");
  expect_refused("tvg decode walk.tvg -o back.pc2");
  expect_refused("tvg decode walk.tvg -o m.mdd");  // the mesh beside it
  expect_refused("tvg decode walk.tvg -o seq_%04d.ply", "than seq_%04d.ply");
  expect_refused("tvg decode walk.tvg -o seq_####.ply");
  expect_refused("tvg decode walk.tvg -o one.obj");
  expect_refused("tvg decode walk.tvg -o - >>walk.tvg", "standard output");
}

TEST_F(OverInput, JoinNeverOverwritesAPart) {
  expect_refused("tvg join hand.tvg hand2.tvg -o hand.tvg");
  expect_refused("tvg join hand.tvg -o hand2.tvg");
}

TEST_F(OverInput, MeasureNeverOverwritesWhatItReads) {
  expect_refused("tvg measure walk/w_%04d.ply --ply walk/w_%04d.ply");
  expect_refused("tvg measure walk --ply walk/w_0003.ply --frame 3");
  good("ln hand.pc2 c_0007.ply");
  expect_refused("tvg measure hand.obj hand.pc2 --ply c_%04d.ply");
}

#ifdef TVG_HAS_PLAYER
TEST_F(OverInput, RenderAndPlayNeverOverwriteWhatTheyRead) {
  good("ln hand.tvg p.png && ln hand.tvg p_0002.png && ln hand.pc2 ref.png && ln hand.tvg r.json");
  expect_refused("tvg render hand.tvg -o p.png");
  expect_refused("tvg render hand.tvg -o p_%04d.png");
  expect_refused("tvg render hand.tvg --ref hand.obj hand.pc2 --overlay error -o ref.png");
  expect_refused("tvg play hand.tvg --screenshot p.png");
  expect_refused("tvg play hand.tvg --report r.json");
  expect_refused("tvg measure hand.tvg --picture p.png");
}
#endif

}  // namespace
}  // namespace tvg::cli::testing
