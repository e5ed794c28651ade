#include "encoder/importers/open_source.hpp"
#include "encoder/importers/quarter_turn.hpp"
#include "tests/importers/sample_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// Files and sequences as users have them, each kind by the smallest file that shows it.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Parser = void (*)(const std::string&, std::string_view, MeshFile&);

MeshFile parsed(Parser parser, const std::string& bytes) {
  MeshFile mesh;
  parser("file", bytes, mesh);
  return mesh;
}

std::string with_line_ends(std::string text, const std::string& end) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += end.size())
    text.replace(at, 1, end);
  return text;
}

TEST(LenientText, MarksLineEndsAndMissingLastEndsAreAllTheSame) {
  const std::vector<std::pair<Parser, std::string>> samples = {{parse_obj, sample_obj()},
                                                               {parse_off, sample_off()},
                                                               {parse_ply, sample_ply_ascii()},
                                                               {parse_stl, sample_stl_ascii()}};
  for (const auto& [parser, text] : samples) {
    const MeshFile plain = parsed(parser, text);
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      for (const std::string mark : {"", "\xef\xbb\xbf"}) {
        const MeshFile mesh = parsed(parser, mark + with_line_ends(text, end));
        EXPECT_EQ(mesh.positions, plain.positions);
        EXPECT_EQ(mesh.faces, plain.faces);
        EXPECT_EQ(mesh.notes, plain.notes);
      }
    }
    EXPECT_EQ(parsed(parser, text.substr(0, text.size() - 1)).faces, plain.faces);
  }
}

TEST(LenientText, Utf16IsNamed) {
  std::string wide = "\xff\xfe";
  for (const char c : sample_obj()) wide.append({c, '\0'});
  for (const Parser parser : {parse_obj, parse_off, parse_ply, parse_stl}) {
    EXPECT_THAT(thrown_by([&] { parsed(parser, wide); }).what(), HasSubstr("file is text in UTF-16"));
    EXPECT_THAT(thrown_by([&] { parsed(parser, "\xfe\xff" + wide.substr(2)); }).what(), HasSubstr("file"));
  }
}

TEST(LenientText, DecimalCommasAreNamed) {
  EXPECT_THAT(thrown_by([] { parsed(parse_obj, "v 0,5 1 2\nf 1 1 1\n"); }).what(),
              HasSubstr("line 1: '0,5' stands where a number should be: numbers have a decimal point"));
}

TEST(LenientFaces, FacesOfOneOrTwoCornersAreLeftOutAndCounted) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\nf 3\n";
  const std::string off = "OFF3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n1 2\n";
  for (const MeshFile& mesh : {parsed(parse_obj, obj), parsed(parse_off, off)}) {
    EXPECT_THAT(mesh.faces, ElementsAre(Face{0, 1, 2}));
    EXPECT_THAT(mesh.notes, ElementsAre("2 faces with fewer than three corners left out"));
  }
}

TEST(LenientFaces, VerticesWithoutAPlaceAreKeptWhereNoFaceUsesThem) {
  const std::string rest = "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 3 4\n";
  for (const std::string bad : {"v nan 0 0\n", "v 0 inf 0\n", "v 1.#QNAN -1.#IND 0\n"}) {
    const MeshFile mesh = parsed(parse_obj, bad + rest);
    EXPECT_THAT(mesh.misplaced, ElementsAre(0U));
    EXPECT_EQ(mesh.positions[1], 0);
    EXPECT_THAT(thrown_by([&] { parsed(parse_obj, bad + rest + "f 1 2 3\n"); }).what(),
                HasSubstr("file, line 1: vertex 0 has a coordinate that is NaN or infinite"));
  }
}

TEST(PlyReader, ReadsStripsOfTrianglesTurningEveryOther) {
  for (const std::string type : {"int", "char", "short"}) {
    const MeshFile mesh =
        parsed(parse_ply,
               "ply \nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
               "z\nelement tristrips 1\nproperty list int " +
                   type +
                   " vertex_indices\nend_header \n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n"
                   "9 0 1 2 3 -1 2 3 4 -1\n");
    EXPECT_THAT(mesh.faces, ElementsAre(Face{0, 1, 2}, Face{2, 1, 3}, Face{2, 3, 4}));
  }
}

TEST(StlReader, CountsByTheSizeWhereTheHeaderWasNeverFilledIn) {
  std::string bytes = sample_stl_binary(tetrahedron_positions(0));
  bytes.replace(80, 4, 4, '\0');
  const MeshFile mesh = parsed(parse_stl, bytes);
  EXPECT_EQ(mesh.faces.size(), 4U);
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("says 0 triangles, which was never put right: 4 follow")));
}

class LenientSequence : public ::testing::Test {
 protected:
  std::string obj(float x, const std::string& faces = "f 1 2 3\nf 1 3 4\n") const {
    return "v " + std::to_string(x) + " 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + faces;
  }
  OpenedSource open(const std::vector<std::string>& names, Gaps gaps = Gaps::kRefuse,
                    bool empty_frames = true) const {
    SourceSpec spec;
    for (const std::string& name : names) spec.inputs.push_back(folder_.path(name));
    spec.sequence.gaps = gaps;
    spec.sequence.empty_frames = empty_frames;
    return open_source(spec);
  }
  /// x of the first vertex in every frame.
  std::vector<float> walk(const OpenedSource& opened) const {
    const Frames result = read_all(*opened.source);
    EXPECT_FALSE(result.error) << result.error.value_or(Error{}).message;
    std::vector<float> x;
    for (const FramePositions& frame : result.frames) x.push_back(frame[0]);
    return x;
  }

  TemporaryFolder folder_;
};

TEST_F(LenientSequence, FacesMayTurnAndStandInAnotherOrder) {
  folder_.write("s/f0.obj", obj(0));
  folder_.write("s/f1.obj", obj(1, "f 2 3 1\nf 4 1 3\n"));
  folder_.write("s/f2.obj", obj(2, "f 3 4 1\nf 1 2 3\n"));
  EXPECT_THAT(walk(open({"s"})), ElementsAre(0, 1, 2));
  folder_.write("q/f0.obj", obj(0, "f 1 2 3 4\n"));
  folder_.write("q/f1.obj", obj(1, "f 2 3 4 1\n"));
  EXPECT_THAT(walk(open({"q"})), ElementsAre(0, 1));
}

TEST_F(LenientSequence, NumbersMayHaveSignsStepsAndGaps) {
  for (const int number : {-2, -1, 0, 1})
    folder_.write(
        "n/m_" + std::string(number < 0 ? "-00" : "000") + std::to_string(std::abs(number)) + ".obj",
        obj(static_cast<float>(number)));
  for (const std::string name : {"n", "n/m_%04d.obj"})
    EXPECT_THAT(walk(open({name})), ElementsAre(-2, -1, 0, 1));
  for (const int number : {0, 5, 10})
    folder_.write("e/m" + std::to_string(number) + ".obj", obj(static_cast<float>(number)));
  EXPECT_THAT(walk(open({"e"})), ElementsAre(0, 5, 10));
  for (const int number : {0, 1, 4})
    folder_.write("g/m" + std::to_string(number) + ".obj", obj(static_cast<float>(number)));
  EXPECT_THAT(thrown_by([&] { open({"g"}); }).what(), HasSubstr("g/m2.obj is missing"));
  EXPECT_THAT(walk(open({"g"}, Gaps::kHold)), ElementsAre(0, 1, 1, 1, 4));
  EXPECT_THAT(walk(open({"g"}, Gaps::kSkip)), ElementsAre(0, 1, 4));
}

TEST_F(LenientSequence, FoldersAreOnePatternListsAreSortedAndFramesMayHaveFolders) {
  for (const int number : {2, 10}) {
    const std::string text = std::to_string(number);
    folder_.write("s/f" + text + ".obj", obj(static_cast<float>(number)));
    folder_.write("d/" + text + "/mesh.obj", obj(static_cast<float>(number)));
  }
  EXPECT_THAT(walk(open({"s/f10.obj", "s/f2.obj"})), ElementsAre(2, 10));
  EXPECT_THAT(walk(open({"d"})), ElementsAre(2, 10));
  EXPECT_THAT(walk(open({"d/%d/mesh.obj"})), ElementsAre(2, 10));
  folder_.write("s/template.obj", obj(0));
  const OpenedSource opened = open({"s"});
  EXPECT_THAT(opened.notes, Contains(HasSubstr("left out, not named so: template.obj")));
  EXPECT_THAT(walk(opened), ElementsAre(2, 10));
  folder_.write("s/g1.obj", obj(0));
  folder_.write("s/g2.obj", obj(0));
  EXPECT_THAT(thrown_by([&] { open({"s"}); }).what(), HasSubstr("has more than one sequence"));
  EXPECT_THAT(open({"s/f2.obj"}).notes, Contains(HasSubstr("looks like one file of the sequence")));
  EXPECT_THAT(thrown_by([&] { open({"s/f*.obj"}); }).what(), HasSubstr("are no patterns here: there is "));
  EXPECT_THAT(thrown_by([&] { open({"s/f_%04d.obj"}); }).what(), HasSubstr("; there is "));
}

TEST_F(LenientSequence, AnEmptyFrameIsNamedHeldOrSkipped) {
  for (const int number : {0, 1, 2}) {
    folder_.write("s/f" + std::to_string(number) + ".obj",
                  number == 1 ? std::string("v 0 0 0\n") : obj(static_cast<float>(number)));
  }
  const Frames refused = read_all(*open({"s"}, Gaps::kRefuse, false).source);
  ASSERT_TRUE(refused.error);
  EXPECT_THAT(refused.error->message, HasSubstr("(frame 1). `--gaps hold`"));
  EXPECT_THAT(walk(open({"s"}, Gaps::kHold, false)), ElementsAre(0, 0, 2));
  EXPECT_THAT(walk(open({"s"}, Gaps::kSkip, false)), ElementsAre(0, 2));
}

/// What comes of a source: "4" for a mesh of so many vertices, then a letter for each frame.
std::string steps_of(FrameSource& source) {
  std::string steps = std::to_string(source.mesh().vertex_count);
  FramePositions frame;
  for (;;) {
    const Result<SourceStep> step = read_step(source, frame);
    if (!step || *step == SourceStep::kEnd) return steps + (step ? "" : "!");
    steps += *step == SourceStep::kFrame ? "f" : std::to_string(source.mesh().vertex_count);
  }
}

TEST_F(LenientSequence, AFileWithoutFacesIsAFrameThatShowsNothing) {
  for (const int number : {0, 1, 2, 3, 4}) {
    folder_.write("s/f" + std::to_string(number) + ".obj",
                  number % 3 == 0 ? std::string() : obj(static_cast<float>(number)));
  }
  const OpenedSource opened = open({"s"});
  EXPECT_EQ(steps_of(*opened.source), "1f4ff1f4f");
  EXPECT_THAT(opened.later->texts(), Contains(HasSubstr("the frame shows nothing")));
  ASSERT_TRUE(opened.source->rewind());
  EXPECT_EQ(steps_of(*opened.source), "1f4ff1f4f");
  folder_.write("n/f0.obj", "");
  folder_.write("n/f1.obj", "");
  EXPECT_THAT(thrown_by([&] { open({"n"}); }).what(), HasSubstr("no other file of the sequence has any"));
}

TEST_F(LenientSequence, AMeshThatComesAgainIsKnownWhateverTheOrderOfItsFaces) {
  const std::string other = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  const std::vector<std::string> files = {obj(0), other, obj(2, "f 3 4 1\nf 2 3 1\n"), other, obj(4)};
  for (std::size_t i = 0; i < files.size(); ++i) folder_.write("s/f" + std::to_string(i) + ".obj", files[i]);
  const OpenedSource opened = open({"s"});
  FrameSource& source = *opened.source;
  const Mesh first = source.mesh();
  EXPECT_EQ(steps_of(source), "4f3f4f3f4f");
  EXPECT_EQ(source.mesh(), first);
  ASSERT_TRUE(source.rewind());
  FramePositions frame;
  for (int step = 0; step < 4; ++step) ASSERT_TRUE(read_step(source, frame));
  EXPECT_EQ(source.mesh(), first);
  ASSERT_EQ(*read_step(source, frame), SourceStep::kFrame);
  EXPECT_EQ(frame[0], 2);
}

TEST_F(LenientSequence, AVertexWithoutAPlaceStaysWhereItWas) {
  const std::string faces = "f 2 3 4\n";
  folder_.write("s/f0.obj", obj(7, faces));
  folder_.write("s/f1.obj", "v nan 0 0" + obj(0, faces).substr(obj(0).find("\n")));
  EXPECT_THAT(walk(open({"s"})), ElementsAre(7, 7));
}

TEST_F(LenientSequence, FarCoordinatesAreKeptRelativeToAnOrigin) {
  folder_.write(
      "s/f0.obj",
      "v 500000.10 4000000.07 100\nv 500000.12 4000000.07 100\nv 500000.10 4000000.09 100\nf 1 2 3\n");
  folder_.write(
      "s/f1.obj",
      "v 500000.11 4000000.07 100\nv 500000.12 4000000.07 100\nv 500000.10 4000000.09 100\nf 1 2 3\n");
  const OpenedSource opened = open({"s"});
  EXPECT_EQ(opened.source->metadata().at("origin"), "500000.11 4000000.08 100");
  const std::vector<float> x = walk(opened);
  EXPECT_NEAR(x[0], -0.01, 1e-8);
  EXPECT_NEAR(x[1], 0, 1e-8);
}

TEST_F(LenientSequence, TrianglesOfStlAreMatchedAndCornersWeldedWithinATolerance) {
  const std::string first = sample_stl_binary(tetrahedron_positions(0));
  std::string second = sample_stl_binary(tetrahedron_positions(1));
  second = second.substr(0, 84) + second.substr(184, 100) + second.substr(84, 100);
  folder_.write("s/f0.stl", first);
  folder_.write("s/f1.stl", second);
  const Frames result = read_all(*open({"s"}).source);
  ASSERT_FALSE(result.error);
  for (std::size_t vertex = 0; vertex < 4; ++vertex)
    EXPECT_NEAR(result.frames[1][3 * vertex] - result.frames[0][3 * vertex], 0.1, 1e-6);
  FramePositions rough = tetrahedron_positions(1);
  std::string third = sample_stl_binary(rough);
  third[84 + 2 * 50 + 12 + 12] ^= 1;  // the last bit of a coordinate
  folder_.write("r/f0.stl", first);
  folder_.write("r/f1.stl", third);
  EXPECT_EQ(open({"r"}).source->mesh().vertex_count, 4U);
}

TEST_F(LenientSequence, ACacheBesideItsMeshIsTaken) {
  folder_.write("a.obj", sample_obj());
  folder_.write("a.pc2", pc2_bytes(4, 0, 3));
  const OpenedSource opened = open({"a.obj"});
  EXPECT_EQ(opened.source->frame_count(), 3U);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("a.pc2 lies beside")));
  EXPECT_THAT(opened.notes, Contains(HasSubstr("says 0 frames, which was never put right: 3 follow")));
}

TEST_F(LenientSequence, ArraysOfNumpyAreCachesOfEachPrecision) {
  folder_.write("a.obj", sample_obj());
  const auto array = [](const std::string& type, const std::string& order, const std::string& shape,
                        const std::string& data) {
    std::string header =
        "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': (" + shape + "), }";
    header.resize(117, ' ');
    return std::string("\x93NUMPY\1\0v\0", 10) + header + "\n" + data;
  };
  ByteString single(false), twice(true);
  for (const std::size_t frame : {0, 1}) {
    for (const float value : tetrahedron_positions(frame)) {
      single.add(value);
      twice.add(double{value});
    }
  }
  for (const std::string& bytes :
       {array("<f4", "False", "2, 4, 3", single.bytes()), array(">f8", "False", "2, 4, 3", twice.bytes())}) {
    folder_.write("a.npy", bytes);
    EXPECT_EQ(read_all(*open({"a.obj"}).source).frames,
              (std::vector<FramePositions>{tetrahedron_positions(0), tetrahedron_positions(1)}));
  }
  const auto message = [&](const std::string& bytes) {
    folder_.write("a.npy", bytes);
    return std::string(thrown_by([&] { open({"a.obj", "a.npy"}); }).what());
  };
  EXPECT_THAT(message(array("<f4", "True", "2, 4, 3", single.bytes())), HasSubstr("Fortran's order"));
  EXPECT_THAT(message(array("<i4", "False", "2, 4, 3", single.bytes())), HasSubstr("numbers of type '<i4'"));
  EXPECT_THAT(message(array("<f4", "False", "2, 12", single.bytes())), HasSubstr("not [frame][vertex][xyz]"));
  EXPECT_THAT(message(array("<f4", "False", "3, 4, 3", single.bytes())), HasSubstr("inside frame 2"));
}

TEST_F(LenientSequence, UnevenTimesAreTold) {
  folder_.write("a.obj", sample_obj());
  std::string uneven = mdd_bytes(4, 4, 4, 0.04);
  uneven[8 + 4 * 3] = 'B';
  folder_.write("a.mdd", uneven);
  EXPECT_THAT(open({"a.obj"}).notes,
              Contains(HasSubstr("are uneven from frame 3 on: the time of each frame is kept")));
  uneven[8 + 4 * 2] = 'C';  // later than the one behind it
  folder_.write("a.mdd", uneven);
  const OpenedSource falling = open({"a.obj"});
  EXPECT_THAT(falling.notes, Contains(HasSubstr("do not rise from frame to frame, and are left out")));
  EXPECT_THAT(falling.source->data(), IsEmpty());
}

TEST(QuarterTurn, IsFoundBothWaysAndNotWhereThereIsNone) {
  const FramePositions mesh = tetrahedron_positions(0);
  FramePositions z_up, y_up;
  for (std::size_t i = 0; i < mesh.size(); i += 3) {
    z_up.insert(z_up.end(), {mesh[i], -mesh[i + 2], mesh[i + 1]});
    y_up.insert(y_up.end(), {mesh[i], mesh[i + 2], -mesh[i + 1]});
  }
  EXPECT_EQ(find_quarter_turn(mesh, z_up), Turn::kZUpToYUp);
  EXPECT_EQ(find_quarter_turn(mesh, y_up), Turn::kYUpToZUp);
  EXPECT_EQ(find_quarter_turn(mesh, mesh), std::nullopt);
}

}  // namespace
}  // namespace tvg::cli
