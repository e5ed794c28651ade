#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

/// A user who compares what has different meshes.
class Surfaces : public ToolTest {
 protected:
  Surfaces() {
    const Sequence fine = corpus::find_corpus_entry("hand")->make({1570, kFrames}).sequence;
    corpus::write_obj(folder_.path("fine.obj"), fine);
    corpus::write_pc2(folder_.path("fine.pc2"), fine);
    good("tvg encode fine.obj fine.pc2 -o fine.tvg --bits 16 -q");
    good("tvg encode hand.obj hand.pc2 -o hand.tvg --bits 16 -q");
  }
};

TEST_F(Surfaces, OfDifferentMeshesAreComparedByThemselves) {
  const nlohmann::json figures = json("tvg compare fine.tvg hand.tvg --json");
  EXPECT_EQ(figures["frames"], kFrames);
  EXPECT_GT(figures["original_vertices"], figures["other_vertices"]);
  EXPECT_EQ(figures["measured"].size(), kFrames);
  EXPECT_GT(figures["rms"], 0);
  EXPECT_GT(figures["hausdorff"], figures["rms"]);
  EXPECT_LT(figures["relative_hausdorff"], 0.1);
  const std::string words = good("tvg compare fine.tvg hand.tvg").out;
  for (const char* word : {"RMS", "Hausdorff", "% of the diagonal"}) EXPECT_THAT(words, HasSubstr(word));
}

TEST_F(Surfaces, OfTheSameMeshAreComparedVertexByVertexUnlessAskedFor) {
  EXPECT_TRUE(json("tvg compare hand.pc2 hand.tvg --mesh hand.obj --json").contains("snr_db"));
  const nlohmann::json figures = json("tvg compare hand.pc2 hand.tvg --mesh hand.obj --surfaces --json");
  EXPECT_LT(figures["relative_rms"], 1e-4);
  EXPECT_FALSE(figures.contains("snr_db"));
}

TEST_F(Surfaces, InAnotherOrderOfVerticesAreOtherMeshes) {
  good("tvg encode hand.obj hand.pc2 -o other.tvg --bits 16 --reorder -q");
  EXPECT_LT(json("tvg compare hand.pc2 other.tvg --mesh hand.obj --json")["relative_rms"], 1e-4);
}

TEST_F(Surfaces, AreMeasuredAtTheFramesAndPointsAskedFor) {
  const std::string compare = "tvg compare fine.tvg hand.tvg --json ";
  EXPECT_EQ(json(compare + "--hausdorff 5")["measured"].size(), 3U);
  EXPECT_NE(json(compare + "--samples 100")["rms"], json(compare)["rms"]);
  expect_failure(compare + "--samples 0", 1, "--samples");
}

TEST_F(Surfaces, OfDifferentLengthCannotBeCompared) {
  good("tvg encode hand.obj hand.pc2 --frames 0-4 -o short.tvg -q");
  expect_failure("tvg compare fine.tvg short.tvg", 3, "short.tvg ends after 5 frames");
}

}  // namespace
}  // namespace tvg::cli::testing
