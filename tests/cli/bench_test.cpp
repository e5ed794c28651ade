#include "tool_test_fixture.hpp"

#include <cmath>
#include <map>
#include <sstream>
#include <tuple>
#include <vector>

namespace tvg::cli::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

using Row = std::map<std::string, std::string>;

/// The fields of a line as RFC 4180 has them.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[i++];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

/// The rows of a CSV by the names of its columns; every row has all of them.
std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> columns = fields_of(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> fields = fields_of(line);
    EXPECT_EQ(fields.size(), columns.size()) << line;
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(fields.size(), columns.size()); ++i) row[columns[i]] = fields[i];
  }
  return rows;
}

double number(const Row& row, const std::string& column) {
  return std::stod(row.at(column));
}

class BenchTest : public ToolTest {
 protected:
  BenchTest() {
    const Sequence cloth = corpus::find_corpus_entry("cloth")->make({300, 10}).sequence;
    corpus::write_obj(folder_.path("cloth.obj"), cloth);
    corpus::write_pc2(folder_.path("cloth.pc2"), cloth);
  }

  std::vector<Row> rows(const std::string& options) const {
    return rows_of(good("tvg bench -q --runs 1 --csv - " + options).out);
  }

  /// The animations of the rows, each once, in their order.
  std::vector<std::string> animations(const std::string& inputs) const {
    std::vector<std::string> names;
    for (const Row& row : rows("--bits 9 --codecs tvg --mode elp --hausdorff 0 " + inputs))
      names.push_back(row.at("animation"));
    return names;
  }
};

TEST_F(BenchTest, ErrorsFallAndBytesGrowWithBits) {
  const std::vector<Row> all = rows("hand.obj hand.pc2 --bits 7..11");
  std::map<std::string, std::vector<Row>> curves;
  for (const Row& row : all) curves[row.at("codec") + row.at("mode")].push_back(row);
  ASSERT_GE(curves.size(), 3U);  // elp, basis, meshopt, and draco where it is built in
  for (const auto& [name, curve] : curves) {
    ASSERT_EQ(curve.size(), 5U) << name;
    for (std::size_t i = 1; i < curve.size(); ++i) {
      EXPECT_EQ(number(curve[i], "bits"), number(curve[i - 1], "bits") + 1) << name;
      EXPECT_GT(number(curve[i], "bytes"), number(curve[i - 1], "bytes")) << name;
      for (const char* error : {"rms_coordinate_error", "kg_percent", "sted"})
        EXPECT_LT(number(curve[i], error), number(curve[i - 1], error)) << name << " " << error;
    }
  }
}

TEST_F(BenchTest, FiguresAreThoseOfEncodeAndCompare) {
  for (const auto& [one, other] :
       {std::pair("--mode elp --bits 10", "--mode elp --bits 10"),
        std::pair("--mode elp --predictor auto --gop 4 --bits 9", "--predictor auto --gop 4 --bits 9"),
        std::pair("--mode basis --effort 2 --period 8 --bits 9",
                  "--mode basis --effort 2 --period 8 --bits 9"),
        std::pair("--mode elp --bits 11:8 --important 20% --smooth 1",
                  "--bits 11:8 --important 20% --smooth 1"),
        std::pair("--mode lossless", "--lossless"),
        std::pair("--mode elp --bits 9 --frames 2-7", "--bits 9 --frames 2-7")}) {
    const std::vector<Row> made = rows(std::string("hand.obj hand.pc2 --codecs tvg --hausdorff 1 ") + one);
    ASSERT_EQ(made.size(), 1U) << one;
    const auto encoded = json(std::string("tvg encode hand.obj hand.pc2 --json -o hand.tvg ") + other);
    EXPECT_EQ(std::stoull(made[0].at("bytes")), encoded["bytes"]) << one;
    EXPECT_NEAR(number(made[0], "bits_per_coordinate"), encoded["bits_per_coordinate"], 1e-9) << one;
    EXPECT_NEAR(number(made[0], "bits_per_vertex_frame"), 3 * encoded["bits_per_coordinate"].get<double>(),
                1e-9);
    if (std::string(one).find("--frames") != std::string::npos) continue;
    const auto errors = json("tvg compare hand.pc2 hand.tvg --mesh hand.obj --hausdorff 1 --json");
    for (const char* figure : {"rms_coordinate_error", "max_coordinate_error", "kg_percent", "sted",
                               "hausdorff", "relative_hausdorff", "relative_rms_coordinate_error"})
      EXPECT_DOUBLE_EQ(number(made[0], figure), errors[figure]) << one << " " << figure;
  }
}

TEST_F(BenchTest, OtherCodecsHaveTheErrorOfTheSameLattice) {
  const std::vector<Row> made =
      rows("hand.obj hand.pc2 --mode elp --bits 10 --codecs tvg,meshopt,meshopt+zstd,zstd");
  ASSERT_EQ(made.size(), 4U);
  for (const Row& row : made) {
    EXPECT_NEAR(number(row, "rms_coordinate_error"), number(made[0], "rms_coordinate_error"),
                1e-6 * number(made[0], "rms_coordinate_error"))
        << row.at("codec");
    EXPECT_EQ(row.at("hausdorff_frames"), "6");  // of 12 frames every second
    EXPECT_GE(number(row, "decode_seconds"), 0);
  }
  // Two resolutions are TVG's alone.
  EXPECT_EQ(rows("hand.obj hand.pc2 --mode elp --bits 11:9 --codecs tvg,meshopt").size(), 1U);
}

TEST_F(BenchTest, EachAnimationHasItsRows) {
  EXPECT_THAT(animations("hand.obj hand.pc2 cloth.obj cloth.pc2"), ElementsAre("hand", "cloth"));
  EXPECT_THAT(animations("cloth.obj hand.obj cloth.pc2 hand.pc2"), ElementsAre("cloth", "hand"));
  EXPECT_THAT(animations("hand.obj cloth.obj"), ElementsAre("hand", "cloth"));  // caches beside them
  good(
      "mkdir a b && cp hand.pc2 a/x.pc2 && tvg decode -q \"$(tvg encode -q cloth.obj -o c.tvg; echo c.tvg)\" "
      "-o b/c_%04d.obj");
  // Names that would be the same are told apart by their files.
  EXPECT_THAT(animations("b hand.obj a/x.pc2 c.tvg b/c_%04d.obj"),
              ElementsAre("b", "hand", "c.tvg", "b/c_%04d.obj"));
  const std::string table = good("tvg bench hand.obj cloth.obj --bits 9 --mode elp,lossless --runs 1").out;
  EXPECT_THAT(table, HasSubstr("hand: 394 vertices, 784 faces, 12 frames"));
  EXPECT_THAT(table, HasSubstr("cloth: "));
  EXPECT_THAT(table, HasSubstr("tvg lossless"));
  EXPECT_THAT(table, HasSubstr("meshopt "));
}

TEST_F(BenchTest, FramesThatAShellHasListedAreNoAnimations) {
  good("mkdir b && tvg encode cloth.obj -q -o c.tvg && tvg decode -q c.tvg -o b/c_%04d.obj");
  expect_failure("tvg bench b/c_*.obj", 1, "frames of one sequence");
  expect_failure("tvg bench b/c_*.obj", 1, "c_%04d.obj");
}

TEST_F(BenchTest, AllButTheTimesIsTheSameWhateverTheThreads) {
  std::vector<Row> one =
      rows("hand.obj cloth.obj --bits 8,11:9,11 --gop 3 --period 6 --mode elp,basis,lossless --threads 1");
  std::vector<Row> four =
      rows("hand.obj cloth.obj --bits 8,11:9,11 --gop 3 --period 6 --mode elp,basis,lossless --threads 4");
  ASSERT_EQ(one.size(), four.size());
  for (std::vector<Row>* all : {&one, &four}) {
    for (Row& row : *all) {
      std::erase_if(row, [](const auto& entry) { return entry.first.find("second") != std::string::npos; });
      EXPECT_EQ(row.size(), 22U);
    }
  }
  EXPECT_EQ(one, four);
}

TEST_F(BenchTest, OneRunWritesEveryReport) {
  const Outcome outcome =
      good("tvg bench hand.obj --bits 8,9 --mode elp --codecs tvg --runs 1 --csv a.csv --plot a.svg");
  EXPECT_THAT(outcome.out, HasSubstr("tvg elp"));
  EXPECT_EQ(rows_of(folder_.read("a.csv")).size(), 2U);
  EXPECT_THAT(folder_.read("a.svg"), HasSubstr(">tvg elp</text>"));
  const auto report = json("tvg bench hand.obj --bits 8,9 --mode elp --codecs tvg --runs 1 -q --json");
  ASSERT_EQ(report["animations"].size(), 1U);
  EXPECT_EQ(report["animations"][0]["rows"].size(), 2U);
  EXPECT_EQ(report["animations"][0]["rows"][1]["bits"], 9);
  EXPECT_TRUE(report["animations"][0]["rows"][1]["hausdorff"].is_number());
  // A name with a comma stays one field.
  good("cp hand.obj 'a,b.obj' && cp hand.pc2 'a,b.pc2'");
  EXPECT_EQ(rows("'a,b.obj' --bits 8 --mode elp --codecs tvg --hausdorff 0")[0].at("animation"), "a,b");
  EXPECT_EQ(rows("hand.obj --bits 8 --mode elp --codecs tvg --hausdorff 0")[0].at("hausdorff"), "");
}

TEST_F(BenchTest, WhatIsWrongIsAnsweredWithWhatWouldBeRight) {
  for (const char* bits : {"13..7", "7..", "x", "7,,9", "0..3", "20..25", "9:7..13:12", "7-13", "9:11"})
    expect_failure(std::string("tvg bench hand.obj --csv a.csv --bits ") + bits, 1, "write a range as 7..13");
  expect_failure("tvg bench hand.obj --bits 7..17", 1, "at most 16 bits");
  expect_failure("tvg bench hand.obj --mode elb", 1, "write elp, basis or lossless");
  expect_failure("tvg bench hand.obj --codecs famc", 1, "write some of tvg, draco, meshopt");
  expect_failure("tvg bench hand.obj --important 30%", 1, "two resolutions");
  expect_failure("tvg bench hand.obj --mode elp --period 8", 1, "--period is of mode basis");
  expect_failure("tvg bench hand.obj --json --csv -", 1, "name a file");
  expect_failure("tvg bench hand.obj --plot a.png", 1, "plots are SVG");
  expect_failure("tvg bench hand.obj --csv hand.pc2", 1, "it is an input");
  expect_failure("tvg bench hand.pc2", 1, "hand.obj");
  expect_failure("tvg bench gone.obj --csv a.csv", 2, "gone.obj");
  good("head -c 20000 hand.pc2 >cut.pc2");
  expect_failure("tvg bench hand.obj cut.pc2 --csv a.csv", 3, "cut.pc2");
  good("test ! -e a.csv");
}

}  // namespace
}  // namespace tvg::cli::testing
