#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

/// Decoding several GOPs at a time must not show, in frames or in messages.
class DecodeThreads : public ToolTest {
 protected:
  DecodeThreads() { good("tvg encode hand.obj hand.pc2 -o hand.tvg --bits 12:10 --gop 2 -q"); }

  void expect_the_same(const std::string& command, int status) const {
    const Outcome one = run(command + " -o one.pc2 --threads 1");
    EXPECT_EQ(one.status, status) << one.err;
    for (const char* threads : {"2", "3", "16"}) {
      const Outcome several = run(command + " -o several.pc2 --threads " + threads);
      EXPECT_EQ(several.status, status) << several.err;
      std::string err = several.err;
      for (std::size_t at = err.find("several"); at != std::string::npos; at = err.find("several"))
        err.replace(at, 7, "one");
      EXPECT_EQ(err, one.err);
      if (status != 0) continue;
      EXPECT_EQ(folder_.read("several.pc2"), folder_.read("one.pc2")) << threads;
    }
  }
};

TEST_F(DecodeThreads, GiveTheSameFrames) {
  expect_the_same("tvg decode hand.tvg", 0);
  expect_the_same("tvg decode hand.tvg --frames 3-8", 0);
  expect_the_same("tvg decode hand.tvg --frames 11", 0);
}

TEST_F(DecodeThreads, GiveTheSameFramesOfSeveralMeshes) {
  good(
      "tvg encode hand.obj hand.pc2 -o other.tvg --reorder --frames 0-5 -q && tvg join hand.tvg other.tvg -o "
      "both.tvg -q");
  for (const char* threads : {"1", "3"}) {
    good(std::string("tvg decode both.tvg -o ") + (threads[0] == '1' ? "a" : "b") +
         "_%02d.off -q --threads " + threads);
  }
  good("for i in 00 05 11 12 17; do cmp a_$i.off b_$i.off || exit 1; done");
}

TEST_F(DecodeThreads, TellTheSameDamage) {
  const auto gops = chunks("hand.tvg", "GOP ");
  ASSERT_EQ(gops.size(), 6U);
  flip_byte("hand.tvg", gops[2].first + gops[2].second / 2);
  EXPECT_THAT(good("tvg decode hand.tvg -o a.pc2 --conceal --threads 3").err, HasSubstr("lost"));
  expect_the_same("tvg decode hand.tvg --conceal", 0);
  expect_the_same("tvg decode hand.tvg", 3);
  expect_the_same("tvg decode hand.tvg --frames 0-3", 0);
}

TEST_F(DecodeThreads, TellTheSameOfAStreamThatIsCut) {
  good("head -c $(( $(stat -c %s hand.tvg) * 2 / 3 )) hand.tvg >cut.tvg");
  expect_the_same("tvg decode cut.tvg --conceal", 0);
  expect_the_same("tvg decode cut.tvg", 3);
}

}  // namespace
}  // namespace tvg::cli::testing
