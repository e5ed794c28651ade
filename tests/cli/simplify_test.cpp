#include "tool_test_fixture.hpp"

#include <algorithm>
#include <filesystem>

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

/// A user who makes a hand lighter: 394 vertices in 12 frames.
class Simplify : public ToolTest {
 protected:
  Simplify() {
    const corpus::CorpusSequence hand = corpus::find_corpus_entry("hand")->make({400, kFrames});
    corpus::write_skeleton(folder_.path("hand.skeleton.json"), *hand.joints);
    vertices_ = hand_.mesh.vertex_count;
  }

  bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path(name)); }

  std::uint32_t vertices_ = 0;
};

const std::string kSimplify = "tvg simplify hand.obj hand.pc2 ";

TEST_F(Simplify, MakesAStreamOfAllFramesOnOneSmallerMesh) {
  const Outcome said = good(kSimplify + "-o small.tvg --ratio 4");
  EXPECT_THAT(said.err, HasSubstr("hand.obj, hand.pc2: "));
  EXPECT_THAT(said.err, HasSubstr("small.tvg: 12 frames"));
  EXPECT_EQ(said.out, "");
  const nlohmann::json info = json("tvg info small.tvg --json");
  EXPECT_NEAR(info["vertices"].get<double>(), vertices_ / 4.0, 1);
  EXPECT_EQ(info["frames"], kFrames);
  const nlohmann::json figures = json("tvg compare hand.pc2 small.tvg --mesh hand.obj --json");
  EXPECT_LT(figures["relative_rms"], 0.02);
  EXPECT_GT(figures["relative_rms"], 0);
}

TEST_F(Simplify, WritesCachesAndMeshFilesToo) {
  good(kSimplify + "-o small.pc2 --vertices 100 -q");
  EXPECT_TRUE(exists("small.pc2") && exists("small.obj"));
  EXPECT_EQ(json("tvg compare small.pc2 small.pc2 --mesh small.obj --json")["vertices"], 100);
  good(kSimplify + "-o s_%04d.ply --vertices 100 -q");
  EXPECT_TRUE(exists("s_0000.ply") && exists("s_0011.ply") && !exists("s_0012.ply"));
  EXPECT_LT(json("tvg compare small.pc2 s_%04d.ply --mesh small.obj --json")["max_vertex_distance"], 1e-6);
  good(kSimplify + "-o - --vertices 100 -q >piped.pc2 && cmp piped.pc2 small.pc2");
  good(kSimplify + "--frames 3-3 -o one.obj --vertices 100 -q");
  EXPECT_TRUE(exists("one.obj") && !exists("one_0000.obj"));
}

TEST_F(Simplify, KeepsPositionsOfTheVerticesThatStay) {
  good(kSimplify + "-o small.pc2 --ratio 3 -q");
  const FramePositions& frame = hand_.frames.front();
  const std::string bytes = folder_.read("small.pc2");
  std::array<float, 3> first;
  std::memcpy(first.data(), bytes.data() + 32, sizeof(first));
  bool found = false;
  for (std::size_t v = 0; v < vertices_; ++v)
    found =
        found || std::equal(first.begin(), first.end(), frame.begin() + static_cast<std::ptrdiff_t>(3 * v));
  EXPECT_TRUE(found);
}

TEST_F(Simplify, ReadsStreams) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg -q && tvg simplify hand.tvg -o small.tvg --ratio 4 -q");
  EXPECT_EQ(json("tvg info small.tvg --json")["frames"], kFrames);
  expect_failure("tvg simplify hand.tvg -o small.tvg --ratio 4 --frames 1-2", 1, "--frames: not for a .tvg");
}

TEST_F(Simplify, TakesEveryPriority) {
  for (const std::string priority :
       {"maps", "curv", "curv+0.5*velocity", "maps --lambda 0.9", "skel --skeleton hand.skeleton.json",
        "curv+skel --skeleton hand.skeleton.json"}) {
    const nlohmann::json report = json(kSimplify + "-o small.tvg --ratio 3 -q --json --priority " + priority);
    EXPECT_EQ(report["priority"], priority.substr(0, priority.find(' ')));
    EXPECT_GT(report["mean_quadric_error"], 0);
  }
  EXPECT_NE(json(kSimplify + "-o a.tvg --ratio 3 --json --priority maps")["mean_quadric_error"],
            json(kSimplify + "-o a.tvg --ratio 3 --json --priority curv")["mean_quadric_error"]);
}

TEST_F(Simplify, ReportsLevelsFramesAndDistances) {
  const std::string simplify = kSimplify + "-o small.tvg --ratio 4 -q --report r.";
  good(simplify + "json");
  const nlohmann::json report = nlohmann::json::parse(folder_.read("r.json"));
  EXPECT_EQ(report["original_vertices"], vertices_);
  EXPECT_EQ(report["results"].size(), kFrames);
  EXPECT_EQ(report["distance"]["measured"].size(), kFrames);
  ASSERT_GE(report["levels"].size(), 2U);
  EXPECT_EQ(report["levels"].back()["vertices"], report["vertices"]);
  EXPECT_EQ(report["levels"].back()["quadric_error"].size(), kFrames);
  EXPECT_EQ(report, json(kSimplify + "-o small.tvg --ratio 4 --json"));

  good(simplify + "csv");
  const std::string csv = folder_.read("r.csv");
  EXPECT_THAT(csv, ::testing::StartsWith("level,vertices,faces,removed,refused,frame,quadric_error,rms,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
            static_cast<std::ptrdiff_t>(1 + report["levels"].size() * kFrames));
  good(simplify + "svg");
  EXPECT_THAT(folder_.read("r.svg"), HasSubstr("quadric error"));
  expect_failure(simplify + "txt", 1, "write report.csv, report.json or report.svg");
}

TEST_F(Simplify, MeasuresTheDistanceAsOftenAsAskedFor) {
  const std::string simplify = kSimplify + "-o small.tvg --ratio 4 --json ";
  EXPECT_EQ(json(simplify + "--distance-stride 5")["distance"]["measured"].size(), 3U);
  EXPECT_TRUE(json(simplify + "--no-distance")["distance"].is_null());
}

TEST_F(Simplify, FramesThatDoNotFitIntoMemoryAreLookedAtEvenlySpread) {
  const Sequence large = corpus::find_corpus_entry("hand")->make({25090, 6}).sequence;
  corpus::write_obj(folder_.path("large.obj"), large);
  corpus::write_pc2(folder_.path("large.pc2"), large);
  const std::string simplify =
      "tvg simplify large.obj large.pc2 -o s.pc2 --ratio 2 --no-distance --memory 1 ";
  EXPECT_THAT(good(simplify).err, HasSubstr("note: 3 of 6 frames, evenly spread, decide"));
  const nlohmann::json results = json(simplify + "--json")["results"];
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[2]["frame"], 5);
  EXPECT_EQ(std::filesystem::file_size(folder_.path("s.pc2")), 32 + 12545 * 12 * 6);
  expect_failure("cat large.pc2 | tvg simplify large.obj - -o s.tvg --ratio 2 --memory 1", 1,
                 "write them to a file first, or raise --memory");
  expect_failure(simplify + "--per-keyframe", 1, "raise --memory");
  good("cat hand.pc2 | tvg simplify hand.obj - -o piped.tvg --ratio 2 -q");
  EXPECT_EQ(json("tvg info piped.tvg --json")["frames"], kFrames);
}

TEST_F(Simplify, CanTakeEveryFrameByItself) {
  good(kSimplify + "--per-keyframe --ratio 4 -o k_%04d.ply -q --report k.csv");
  EXPECT_TRUE(exists("k_0011.ply"));
  EXPECT_NE(folder_.read("k_0000.ply").substr(folder_.read("k_0000.ply").size() - 100),
            folder_.read("k_0011.ply").substr(folder_.read("k_0011.ply").size() - 100));
  const std::string csv = folder_.read("k.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + kFrames);
  good(kSimplify + "--per-keyframe --ratio 4 -o k.tvg -q && tvg verify k.tvg -q");
  EXPECT_EQ(json("tvg info k.tvg --json")["frames"], kFrames);
  const nlohmann::json each = json(kSimplify + "--per-keyframe --ratio 4 -o k.tvg --json");
  EXPECT_EQ(each["results"].size(), kFrames);
  expect_failure(kSimplify + "--per-keyframe --ratio 4 -o k.pc2", 1, "cache holds one mesh");
}

TEST_F(Simplify, RemeshingPutsVerticesOfASubdivisionOnTheOriginal) {
  const std::string simplify = kSimplify + "-o r.tvg --ratio 6 --bits 16 --json ";
  const nlohmann::json coarse = json(simplify), once = json(simplify + "--remesh 1");
  EXPECT_EQ(once["remeshed_faces"], 4 * coarse["faces"].get<int>());
  EXPECT_LT(once["distance"]["rms"], coarse["distance"]["rms"]);
  EXPECT_EQ(json("tvg info r.tvg --json")["vertices"], once["remeshed_vertices"]);
  const nlohmann::json some = json(simplify + "--remesh 3 --remesh-distance 0.3");
  EXPECT_LT(some["remeshed_faces"], 64 * coarse["faces"].get<int>());
  expect_failure(kSimplify + "-o r.tvg --ratio 6 --remesh 11", 1, "--remesh 11: at most 10");
  expect_failure(kSimplify + "-o r.tvg --ratio 6 --remesh-distance 1", 1, "--remesh LEVELS");
  expect_failure(kSimplify + "-o r.tvg --ratio 6 --remesh 1 --per-keyframe", 1, "--per-keyframe");
}

TEST_F(Simplify, SaysWhatKeepsVerticesOfABrokenMesh) {
  const Sequence soup = corpus::find_corpus_entry("soup")->make({600, 3}).sequence;
  corpus::write_obj(folder_.path("soup.obj"), soup);
  corpus::write_pc2(folder_.path("soup.pc2"), soup);
  const Outcome said = good("tvg simplify soup.obj soup.pc2 -o soup.tvg --ratio 3");
  EXPECT_THAT(said.err, HasSubstr("more than two faces, or faces turned against each other: vertices there"));
  good("tvg verify soup.tvg -q");
}

TEST_F(Simplify, OneFrameIsEnough) {
  good("tvg simplify hand.obj -o small.ply --frames 0 --ratio 4 -q");
  EXPECT_TRUE(exists("small.ply"));
}

TEST_F(Simplify, SaysWhatWouldBeRight) {
  const std::string to = kSimplify + "-o no.tvg ";
  expect_failure(to, 1, "--ratio 6 (times fewer vertices) or --vertices 1000");
  expect_failure(to + "--ratio 2 --vertices 100", 1, "give one of them");
  expect_failure(to + "--ratio 0.5", 1, "--ratio 0.5");
  expect_failure(to + "--ratio nan", 1, "--ratio nan");
  expect_failure(to + "--ratio 1000", 1, "ask for 131 or less");
  expect_failure(to + "--vertices 2", 1, "at least 3");
  expect_failure(to + "--vertices 1000", 1, "ask for fewer");
  expect_failure(to + "--ratio 2 --priority skel", 1, "--priority skel: hand.obj, hand.pc2 has no skeleton");
  expect_failure(to + "--ratio 2 --priority mops", 1, "--priority mops: write criteria");
  expect_failure(to + "--ratio 2 --priority curv --lambda 0.2", 1, "--lambda");
  expect_failure(to + "--ratio 2 --priority maps --alpha 0.2", 1, "--alpha");
  expect_failure(to + "--ratio 2 --priority maps --lambda 2", 1, "--lambda 2");
  expect_failure(to + "--ratio 2 --bits 13:11", 1, "--bits 13:11: write one number");
  expect_failure(kSimplify + "-o no.pc2 --ratio 2 --bits 11", 1, "--bits is for a .tvg");
  expect_failure(kSimplify + "-o no.what --ratio 2", 1, "suffix");
  expect_failure(kSimplify + "-o - --ratio 2 --json", 1, "--json");
  folder_.write("points.ply",
                "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                "z\nend_header\n0 0 0\n");
  EXPECT_NE(run("tvg simplify points.ply -o no.tvg --ratio 2").status, 0);
  EXPECT_FALSE(exists("no.tvg"));
}

TEST_F(Simplify, NeverOverwritesWhatItReads) {
  expect_failure(kSimplify + "-o hand.pc2 --ratio 2", 1, "an input");
  expect_failure(kSimplify + "-o hand.mdd --ratio 2", 1, "an input");  // the mesh beside it
  good("ln hand.pc2 r.csv");
  expect_failure(kSimplify + "-o s.tvg --ratio 2 --report r.csv", 1, "an input");
}

}  // namespace
}  // namespace tvg::cli::testing
