#include "tests/cli/tool_test_fixture.hpp"

#ifdef TVG_HAS_PLAYER
#include "player/view/image.hpp"
#endif

#include <algorithm>
#include <cstring>
#include <map>
#include <vector>

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

/// `tvg measure` as a user types it.
class MeasureCommand : public ToolTest {
 protected:
  MeasureCommand() {
    corpus::write_skeleton(folder_.path("hand.skeleton.json"), corpus::make_hand({400, kFrames}).joints);
    std::string weights;
    for (std::uint32_t v = 0; v < hand_.mesh.vertex_count; ++v) weights += std::to_string(v % 4) + "\n";
    folder_.write("w.txt", weights);
  }

  std::size_t vertices() const { return hand_.mesh.vertex_count; }
};

/// A vertex of a PLY that `tvg measure` wrote.
struct PlyVertex {
  float position[3];
  std::uint8_t colour[3];
  float cost, important;
};

std::vector<PlyVertex> vertices_of(const std::string& ply) {
  const std::string end = "end_header\n";
  std::size_t at = ply.find(end) + end.size();
  const std::size_t count_at = ply.find("element vertex ") + 15;
  std::vector<PlyVertex> vertices(std::stoul(ply.substr(count_at)));
  for (PlyVertex& vertex : vertices) {
    if (at + 23 > ply.size()) return {};
    std::memcpy(vertex.position, ply.data() + at, 12);
    std::memcpy(vertex.colour, ply.data() + at + 12, 3);
    std::memcpy(&vertex.cost, ply.data() + at + 15, 4);
    std::memcpy(&vertex.important, ply.data() + at + 19, 4);
    at += 23;
  }
  return vertices;
}

// 394 vertices with the weights 0, 1, 2, 3, 0, ...: 99 of 0, 99 of 1, 98 of 2 and 98 of 3. The histogram's 16
// bins reach from 0 to 3, so that 1 lies in bin 16 / 3 = 5 and 2 in bin 32 / 3 = 10.
TEST_F(MeasureCommand, TellsHowTheCostIsSpread) {
  ASSERT_EQ(vertices(), 394u);
  const auto report =
      json("tvg measure hand.obj hand.pc2 --measure weights --weights w.txt --important-above 1.5 --json -q");
  ASSERT_EQ(report["gops"].size(), 1u);
  const auto& gop = report["gops"][0];
  EXPECT_EQ(gop["important"], 196);
  EXPECT_DOUBLE_EQ(gop["share"], 196.0 / 394);
  const auto& cost = gop["cost"];
  EXPECT_EQ(cost["smallest"], 0);
  EXPECT_EQ(cost["median"], 1);
  EXPECT_DOUBLE_EQ(cost["mean"], (99 + 2 * 98 + 3 * 98) / 394.0);
  EXPECT_EQ(cost["largest"], 3);
  EXPECT_EQ(cost["lowest_important"], 2);
  EXPECT_EQ(cost["histogram"]["low"], 0);
  EXPECT_EQ(cost["histogram"]["high"], 3);
  std::vector<int> counts(16);
  counts[0] = counts[5] = 99;
  counts[10] = counts[15] = 98;
  EXPECT_EQ(cost["histogram"]["counts"].get<std::vector<int>>(), counts);
}

TEST_F(MeasureCommand, CutsGopsAndFlagsAsEncodingDoes) {
  const std::string options = " --frames 2-11 --gop 4 --measure curv+velocity --important 20% -q";
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --bits 12:9" + options);
  const auto stream = json("tvg info hand.tvg --json --bits");
  const auto report = json("tvg measure hand.obj hand.pc2 --json" + options);
  EXPECT_EQ(report["frames"], 10);
  ASSERT_EQ(report["gops"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(report["gops"][i]["first_frame"], 2 + 4 * i);
    EXPECT_EQ(report["gops"][i]["frame_count"], stream["gops"][i]["frame_count"]);
    EXPECT_EQ(report["gops"][i]["important"], stream["gops"][i]["flagged"]);
  }
  EXPECT_EQ(report["gops"][0]["changed"], 0);
  EXPECT_GT(report["gops"][1]["changed"], 0);
}

TEST_F(MeasureCommand, TellsWhichJointsBend) {
  const std::string command = "tvg measure hand.obj hand.pc2 --measure skel --skeleton hand.skeleton.json -q";
  const auto report = json(command + " --json");
  std::map<std::string, nlohmann::json> joints;
  for (const auto& joint : report["gops"][0]["joints"]) joints[joint["name"]] = joint;
  EXPECT_EQ(joints.size(), report["skeleton"].size());
  EXPECT_TRUE(joints["index_2"]["dynamic"]);
  EXPECT_GT(joints["index_2"]["angle_sum"], 0);
  EXPECT_DOUBLE_EQ(joints["index_2"]["degrees_per_frame"],
                   joints["index_2"]["angle_sum"].get<double>() / (kFrames - 1));
  EXPECT_FALSE(joints["palm"]["dynamic"]);
  EXPECT_TRUE(report["skeleton"][0]["parent"].is_null());
  const auto strict = json(command + " --json --skel-threshold 90");
  for (const auto& joint : strict["gops"][0]["joints"]) EXPECT_FALSE(joint["dynamic"]) << joint;
  EXPECT_THAT(good(command).out, HasSubstr("index_2"));
}

TEST_F(MeasureCommand, ColoursAPlyByCostOrFlags) {
  const std::string command =
      "tvg measure hand.obj hand.pc2 --measure weights --weights w.txt --important-above 1.5 -q --frame 7 ";
  good(command + "--ply cost.ply");
  const std::vector<PlyVertex> by_cost = vertices_of(folder_.read("cost.ply"));
  ASSERT_EQ(by_cost.size(), vertices());
  good(command + "--ply flags.ply --colour flags");
  const std::vector<PlyVertex> by_flags = vertices_of(folder_.read("flags.ply"));
  for (std::size_t v = 0; v < by_cost.size(); ++v) {
    EXPECT_EQ(std::memcmp(by_cost[v].position, &hand_.frames[7][3 * v], 12), 0) << v;
    EXPECT_EQ(by_cost[v].cost, static_cast<float>(v % 4));
    EXPECT_EQ(by_cost[v].important, v % 4 > 1 ? 1.0F : 0.0F);
    EXPECT_EQ(by_flags[v].cost, by_cost[v].cost);
    EXPECT_EQ(by_flags[v].important, by_cost[v].important);
  }
  const auto colour = [](const PlyVertex& vertex) {
    return std::vector<int>(std::begin(vertex.colour), std::end(vertex.colour));
  };
  EXPECT_EQ(colour(by_cost[0]), (std::vector<int>{68, 1, 84})) << "viridis begins dark blue";
  EXPECT_EQ(colour(by_cost[3]), (std::vector<int>{253, 231, 37})) << "and ends yellow";
  EXPECT_EQ(colour(by_flags[0]), colour(by_flags[1]));
  EXPECT_EQ(colour(by_flags[2]), colour(by_flags[3]));
  EXPECT_NE(colour(by_flags[1]), colour(by_flags[2]));
  good("tvg encode cost.ply -o one.tvg -q");
}

TEST_F(MeasureCommand, WritesEveryFrameByPattern) {
  good("tvg measure hand.obj hand.pc2 --frames 3-8 --gop 4 --ply c_%02d.ply -q");
  for (int number = 3; number <= 8; ++number) {
    const std::string name = "c_0" + std::to_string(number) + ".ply";
    ASSERT_TRUE(std::filesystem::exists(folder_.path(name))) << name;
    const std::vector<PlyVertex> read = vertices_of(folder_.read(name));
    ASSERT_EQ(read.size(), vertices());
    EXPECT_EQ(std::memcmp(read[5].position, &hand_.frames[static_cast<std::size_t>(number)][15], 12), 0);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path("c_02.ply")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("c_09.ply")));
}

TEST_F(MeasureCommand, ReadsStreamsAndPipes) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --bits 16 -q");
  EXPECT_EQ(json("tvg measure hand.tvg --gop 5 --json -q")["gops"].size(), 3u);
  expect_failure("tvg measure hand.tvg --frames 0-3", 1, "--frames: not for a .tvg");
  const auto joints = json("tvg measure hand.tvg --measure skel --skeleton hand.skeleton.json --json -q");
  EXPECT_EQ(joints["gops"][0]["joints"].size(), joints["skeleton"].size());
  expect_failure("tvg measure hand.tvg --measure skel --skeleton a.bvh", 1, "from JSON");
  EXPECT_EQ(json("cat hand.pc2 | tvg measure hand.obj - --gop 5 --json -q")["frames"], kFrames);
  flip_byte("hand.tvg", folder_.read("hand.tvg").size() / 2);
  expect_failure("tvg measure hand.tvg", 3, "hand.tvg");
}

TEST_F(MeasureCommand, RefusesWhatCannotBeShown) {
  const std::string command = "tvg measure hand.obj hand.pc2 -q ";
  expect_failure(command + "--frame 3", 1, "--ply cost.ply");
  expect_failure(command + "--frame 12 --ply a.ply", 1, "ends after frame 11");
  expect_failure(command + "--frames 4-9 --frame 3 --ply a.ply", 1, "the first frame measured is 4");
  expect_failure(command + "--frame 3 --ply a_%d.ply", 1, "--frame");
  expect_failure(command + "--ply a.obj", 1, "cost_%04d.ply");
  expect_failure(command + "--ply nowhere/a.ply", 2, "nowhere");
  expect_failure(command + "--colour red --ply a.ply", 1, "--colour");
  expect_failure(command + "--measure skel", 1, "has no skeleton");
  expect_failure(command + "--gop 0", 1, "--gop");
  expect_failure("tvg measure absent.obj hand.pc2", 2, "absent.obj");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("a.ply")));
}

#ifdef TVG_HAS_PLAYER

bool is_orange(const std::uint8_t* pixel) {
  return pixel[0] > 1.4 * pixel[1] && pixel[1] > 1.4 * pixel[2];
}
/// The lower end of viridis.
bool is_violet(const std::uint8_t* pixel) {
  return pixel[2] > 1.4 * pixel[1] && pixel[0] > 1.1 * pixel[1];
}

std::size_t count_pixels(const player::Image& image, int left, int right,
                         bool (*counts)(const std::uint8_t*)) {
  std::size_t count = 0;
  for (int row = 0; row < image.height; ++row) {
    for (int column = left; column < right; ++column) count += counts(image.pixel(column, row)) ? 1 : 0;
  }
  return count;
}

TEST_F(MeasureCommand, DrawsCostAndFlagsSideBySide) {
  const std::string command =
      "tvg measure hand.obj hand.pc2 --measure weights --weights w.txt --size 320x160 --frame 3 ";
  const Outcome outcome = run(command + "--important-above 0.5 --picture all.png -q");
  if (outcome.err.find("cannot draw without a display") != std::string::npos) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  good(command + "--important-above 9 --picture none.png -q");
  const player::Image all = player::read_png(folder_.path("all.png"));
  const player::Image none = player::read_png(folder_.path("none.png"));
  EXPECT_EQ(all.width, 320);
  EXPECT_EQ(all.height, 160);
  EXPECT_GT(count_pixels(all, 160, 320, is_orange), 800u)
      << "orange at the right, where vertices are important";
  EXPECT_LT(count_pixels(none, 160, 320, is_orange), 100u) << "only the legend, where none is";
  EXPECT_GT(count_pixels(all, 0, 160, is_violet), 200u) << "the heat map at the left";
  EXPECT_EQ(count_pixels(all, 0, 160, is_violet), count_pixels(none, 0, 160, is_violet));
  expect_failure(command + "--picture a.jpg", 1, "--picture");
  expect_failure(command + "--picture a.png --size 3x3", 1, "--size");
  expect_failure(command + "--picture nowhere/a.png", 2, "nowhere");
}

TEST_F(MeasureCommand, DrawsTheSkeletonOverTheMesh) {
  const std::string command =
      "tvg measure hand.obj hand.pc2 --skeleton hand.skeleton.json --size 320x160 --measure ";
  const Outcome outcome = run(command + "curv --picture without.png -q");
  if (outcome.err.find("cannot draw without a display") != std::string::npos) GTEST_SKIP() << outcome.err;
  good(command + "curv+0*skel --picture with.png -q");
  EXPECT_GT(player::compare_images(player::read_png(folder_.path("without.png")),
                                   player::read_png(folder_.path("with.png")), 40)
                .far_share,
            0.01);
}

#endif

}  // namespace
}  // namespace tvg::cli::testing
