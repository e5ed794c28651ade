#include "encoder/importers/open_source.hpp"

#include "tests/importers/sample_files.hpp"

#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string obj_frame(std::size_t frame, const std::string& faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n") {
  std::string text;
  const FramePositions positions = tetrahedron_positions(frame);
  for (std::size_t vertex = 0; vertex < 4; ++vertex) {
    text += "v";
    for (std::size_t axis = 0; axis < 3; ++axis)
      text.append(1, ' ').append(std::to_string(positions[3 * vertex + axis]));
    text += "\n";
  }
  return text + faces;
}

class OpenSource : public ::testing::Test {
 protected:
  ToolError refusal(const std::vector<std::string>& inputs) {
    return thrown_by([&] { open_source({inputs, {}}); });
  }
  TemporaryFolder folder_;
};

TEST_F(OpenSource, FindsSequencesByPrintfHashesAndFolder) {
  for (std::size_t frame = 8; frame < 12; ++frame) {
    folder_.write("s/walk_" + std::string(frame < 10 ? "000" : "00") + std::to_string(frame) + ".obj",
                  obj_frame(frame));
    folder_.write("n/walk" + std::to_string(frame) + ".OBJ", obj_frame(frame));
  }
  folder_.write("s/walk_10.obj", "not of the pattern");
  folder_.write("n/walk.mtl", "ignored");
  folder_.write("n/.walk9.obj.tmp1", "ignored");
  for (const std::string name : {"s/walk_%04d.obj", "s/walk_####.obj", "n/walk%d.OBJ", "n", "n/"}) {
    const OpenedSource opened = open_source({{folder_.path(name)}, {}});
    EXPECT_EQ(opened.source->frame_count(), 4U) << name;
    for (int pass = 0; pass < 2; ++pass) {
      const Frames result = read_all(*opened.source);
      ASSERT_EQ(result.frames.size(), 4U) << name;
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_FLOAT_EQ(result.frames[i][0], 0.1F * static_cast<float>(8 + i));
      EXPECT_TRUE(opened.source->rewind());
    }
  }
}

TEST_F(OpenSource, ReadsOneMeshFileAsOneFrameWithNotes) {
  const std::string path = folder_.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const OpenedSource opened = open_source({{path}, {}});
  EXPECT_EQ(read_all(*opened.source).frames.size(), 1U);
  EXPECT_THAT(opened.notes, ElementsAre(path + ": 1 polygons triangulated to 2 triangles"));
}

TEST_F(OpenSource, PrefersAFileToThePatternThatItsNameLooksLike) {
  const std::string path = folder_.write("take#1.obj", obj_frame(0));
  EXPECT_EQ(open_source({{path}, {}}).source->frame_count(), 1U);
}

TEST_F(OpenSource, RefusesGapsWithTheMissingName) {
  for (const int number : {1, 2, 4}) folder_.write("g/f_00" + std::to_string(number) + ".obj", obj_frame(0));
  for (const std::string name : {"g/f_%03d.obj", "g/f_###.obj", "g"}) {
    const ToolError error = refusal({folder_.path(name)});
    EXPECT_EQ(error.status(), ExitStatus::kInvalidInput);
    EXPECT_THAT(error.what(), HasSubstr("g/f_003.obj is missing: the sequence has the numbers 2 and 4"));
  }
}

TEST_F(OpenSource, NamesFileFrameAndDifferenceWhereConnectivityChanges) {
  folder_.write("c/f0.obj", obj_frame(0));
  folder_.write("c/f1.obj", obj_frame(1));
  const auto error_with = [&](const std::string& third) {
    folder_.write("c/f2.obj", third);
    const Frames result = read_all(*open_source({{folder_.path("c")}, {}}).source);
    EXPECT_EQ(result.frames.size(), 2U);
    return result.error.value_or(Error{});
  };
  const Error vertices = error_with("v 0 0 0\n" + obj_frame(2));
  EXPECT_EQ(vertices.code, ErrorCode::kInvalidInput);
  EXPECT_THAT(vertices.message, HasSubstr("c/f2.obj (frame 2) has 5 vertices where "));
  EXPECT_THAT(vertices.message, HasSubstr("c/f0.obj has 4"));
  EXPECT_THAT(vertices.message, HasSubstr("`--frames 0-1` takes those of the one before"));
  EXPECT_THAT(error_with(obj_frame(2, "f 1 2 3\n")).message, HasSubstr("has 1 triangles where"));
  EXPECT_THAT(error_with(obj_frame(2, "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n")).message,
              HasSubstr("has the vertices 1 3 2 in triangle 3, the face turned inside out of one in "));
  const Error cut = error_with("v 0 0 0\nv 1");
  EXPECT_EQ(cut.code, ErrorCode::kTruncated);
  EXPECT_THAT(cut.message, HasSubstr("c/f2.obj ends inside line 2, which has no line end: the file is cut"));
  std::filesystem::remove(folder_.path("c/f2.obj"));
}

TEST_F(OpenSource, ReportsAFileThatVanishesWhileTheSequenceIsRead) {
  folder_.write("v/f0.obj", obj_frame(0));
  folder_.write("v/f1.obj", obj_frame(1));
  const OpenedSource opened = open_source({{folder_.path("v")}, {}});
  std::filesystem::remove(folder_.path("v/f1.obj"));
  const Frames result = read_all(*opened.source);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->code, ErrorCode::kIo);
  EXPECT_THAT(result.error->message, HasSubstr("v/f1.obj: No such file"));
}

TEST_F(OpenSource, TakesConnectivityFromTheFirstFrameOfTheRange) {
  folder_.write("r/f0.obj", "v 0 0 0\nf 1 1 1\n");
  for (std::size_t frame = 1; frame < 5; ++frame) {
    folder_.write("r/f" + std::to_string(frame) + ".obj", obj_frame(frame));
  }
  const OpenedSource opened = open_source({{folder_.path("r")}, FrameRange{1, 3}});
  EXPECT_EQ(opened.source->mesh().vertex_count, 4U);
  const Frames result = read_all(*opened.source);
  ASSERT_EQ(result.frames.size(), 3U);
  EXPECT_FLOAT_EQ(result.frames[2][0], 0.3F);
  EXPECT_THAT(thrown_by([&] {
                open_source({{folder_.path("r")}, FrameRange{1, 5}});
              }).what(),
              HasSubstr("has the frames 0-4"));
}

TEST_F(OpenSource, WeldsStlByWhatLiesInOnePlaceInEveryFrame) {
  folder_.write("w/f0.stl", sample_stl_binary(tetrahedron_positions(0)));
  folder_.write("w/f1.stl", sample_stl_binary(tetrahedron_positions(1)));
  const OpenedSource opened = open_source({{folder_.path("w")}, {}});
  EXPECT_THAT(opened.notes,
              ElementsAre(HasSubstr("f%d.stl, 2 files"), HasSubstr("12 corners welded to 4 vertices")));
  Frames result = read_all(*opened.source);
  ASSERT_EQ(result.frames.size(), 2U);
  EXPECT_FLOAT_EQ(result.frames[1][3], 0.1F);
  std::string torn = sample_stl_binary(tetrahedron_positions(1));
  torn[84 + 2 * 50 + 12 + 12 + 2] ^= 1;
  folder_.write("w/f1.stl", torn);
  const OpenedSource split = open_source({{folder_.path("w")}, {}});
  EXPECT_EQ(split.source->mesh().vertex_count, 5U);
  EXPECT_THAT(split.notes.back(), HasSubstr("come apart later, first in " + folder_.path("w/f1.stl")));
  EXPECT_FALSE(read_all(*split.source).error);
}

TEST_F(OpenSource, KeepsTheFirstStlWeldWhereLaterVerticesCoincide) {
  FramePositions collapsed = tetrahedron_positions(1);
  std::copy_n(collapsed.begin(), 3, collapsed.begin() + 3);
  folder_.write("w/f0.stl", sample_stl_binary(tetrahedron_positions(0)));
  folder_.write("w/f1.stl", sample_stl_binary(collapsed));
  const Frames result = read_all(*open_source({{folder_.path("w")}, {}}).source);
  EXPECT_FALSE(result.error);
  EXPECT_EQ(result.frames.size(), 2U);
}

TEST_F(OpenSource, SaysWhatIsWrongWithInputsThatDoNotFit) {
  const std::string obj = folder_.write("a.obj", obj_frame(0));
  const std::string pc2 = folder_.write("a.pc2", pc2_bytes(4, 2, 2));
  const auto expect_usage = [&](const std::vector<std::string>& inputs, const std::string& part) {
    const ToolError error = refusal(inputs);
    EXPECT_EQ(error.status(), ExitStatus::kUsage);
    EXPECT_THAT(error.what(), HasSubstr(part));
  };
  expect_usage({}, "no input is given");
  expect_usage({pc2}, "add its mesh, which may be " + obj);
  expect_usage({folder_.write("b.mdd", "")}, "add its mesh, a file such as b.obj");
  expect_usage({"-"}, "standard input is a cache of positions and has no faces");
  expect_usage({obj, pc2, pc2}, "are both caches");
  expect_usage({obj, obj}, "is named twice");
  folder_.write("s/f0.obj", obj_frame(0));
  expect_usage({folder_.path("s"), pc2}, "is a sequence");
  expect_usage({folder_.path("s/f%d.obj"), pc2}, "is a sequence");
}

TEST_F(OpenSource, SaysWhatIsWrongWithFilesThatCannotBeRead) {
  const auto expect_error = [&](const std::string& input, ExitStatus status, const std::string& part) {
    const ToolError error = refusal({input});
    EXPECT_EQ(error.status(), status) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(part));
  };
  const auto bad = ExitStatus::kInvalidInput;
  expect_error(folder_.path("none.obj"), ExitStatus::kIo, "none.obj: No such file");
  expect_error(folder_.path("none"), ExitStatus::kIo, "there is no such file");
  expect_error(folder_.path("none_%04d.obj"), ExitStatus::kIo, "no file is named");
  expect_error(folder_.path("none/f_%04d.obj"), ExitStatus::kIo, "cannot read folder");
  expect_error(folder_.write("a.blend", "x"), bad,
               "suffix that is not known: meshes are .obj, .ply, .off or .stl");
  expect_error(folder_.write("a.tvg", "x"), bad, "`tvg decode` turns it into meshes");
  expect_error(folder_.write("a.obj", "\x89TVG\r\n\x1a\n"), bad, "`tvg decode` turns it into meshes");
  expect_error(folder_.write("b.obj", "\x89PNG\r\n\x1a\n"), bad, "b.obj is a PNG image, not an OBJ file");
  expect_error(folder_.write("c.obj", ""), bad, "c.obj is empty");
  folder_.write("empty/readme.txt", "x");
  expect_error(folder_.path("empty"), bad, "holds no .obj, .ply, .off or .stl files");
  folder_.write("mixed/a1.obj", obj_frame(0));
  folder_.write("mixed/a2.ply", sample_ply_ascii());
  expect_error(folder_.path("mixed"), bad, "mixes formats (a1.obj and a2.ply)");
  folder_.write("cache/a.obj", obj_frame(0));
  folder_.write("cache/a.pc2", "x");
  expect_error(folder_.path("cache"), bad, "holds a cache, a.pc2");
}

TEST_F(OpenSource, RefusesAFolderInPlaceOfACache) {
  const std::string obj = folder_.write("a.obj", obj_frame(0));
  folder_.write("a.pc2/x", "x");
  const ToolError error = refusal({obj, folder_.path("a.pc2")});
  EXPECT_EQ(error.status(), ExitStatus::kIo);
  EXPECT_THAT(error.what(), HasSubstr("a.pc2: Is a directory"));
}

TEST(RealData, ReadsWithTheCountsOfItsReadme) {
  const std::string data = data_folder();
  if (data.empty()) GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  struct Expected {
    const char* name;
    std::uint32_t vertices;
    std::size_t faces;
    std::uint64_t frames;
  };
  for (const Expected& expected : {Expected{"chicken", 3030, 5664, 400},
                                   {"cow", 2904, 5804, 204},
                                   {"dance", 7061, 14118, 201},
                                   {"horse-gallop", 8431, 16843, 48},
                                   {"crane", 10002, 20000, 175}}) {
    const std::string stem = data + "/" + expected.name;
    const OpenedSource opened = open_source({{stem + ".obj", stem + ".pc2"}, {}});
    EXPECT_EQ(opened.source->mesh().vertex_count, expected.vertices);
    EXPECT_EQ(opened.source->mesh().faces.size(), expected.faces);
    EXPECT_EQ(opened.source->frame_count(), expected.frames);
    std::vector<float> positions(3 * std::size_t{expected.vertices});
    std::uint64_t frames = 0;
    for (Result<bool> more = opened.source->read_frame(positions); more && *more;
         more = opened.source->read_frame(positions)) {
      ++frames;
    }
    EXPECT_EQ(frames, expected.frames);
    // The OBJ holds the first frame.
    std::vector<float> first(positions.size());
    ASSERT_TRUE(opened.source->rewind());
    ASSERT_TRUE(opened.source->read_frame(positions));
    ASSERT_TRUE(open_source({{stem + ".obj"}, {}}).source->read_frame(first));
    EXPECT_EQ(first, positions) << expected.name;
  }
}

}  // namespace
}  // namespace tvg::cli
