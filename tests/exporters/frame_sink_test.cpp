#include "decoder/exporters/frame_sink.hpp"

#include "encoder/importers/open_source.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <bit>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <sys/resource.h>
#include <thread>

namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Frames of a random mesh whose floats use the whole range of exponents.
Sequence random_sequence(std::size_t frames) {
  std::mt19937 random(3);
  Sequence sequence;
  sequence.mesh.vertex_count = 50;
  for (std::uint32_t face = 0; face < 70; ++face) {
    sequence.mesh.faces.push_back({face % 50, static_cast<std::uint32_t>(random() % 50), (face + 1) % 50});
  }
  for (std::size_t frame = 0; frame < frames; ++frame) {
    FramePositions positions;
    while (positions.size() < 150) {
      const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
      if (std::isfinite(value)) positions.push_back(value);
    }
    sequence.frames.push_back(std::move(positions));
  }
  sequence.frames[0][0] = -0.0F;
  sequence.metadata = {{"fps", "24"}, {"name", "ball"}};
  return sequence;
}

std::vector<std::string> write_all(const std::string& path, const Sequence& sequence, bool count_known,
                                   const SinkOptions& options = {}) {
  const auto sink = open_sink(path, options);
  std::optional<std::uint64_t> count;
  if (count_known) count = sequence.frames.size();
  sink->begin_mesh(sequence.mesh, {}, sequence.metadata, count);
  for (const FramePositions& frame : sequence.frames) sink->write_frame(frame);
  sink->finish();
  return sink->files();
}

void expect_same_bits(const std::vector<FramePositions>& a, const std::vector<FramePositions>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t frame = 0; frame < a.size(); ++frame) {
    ASSERT_EQ(a[frame].size(), b[frame].size());
    EXPECT_EQ(std::memcmp(a[frame].data(), b[frame].data(), 4 * a[frame].size()), 0) << frame;
  }
}

class FrameSinkTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  Sequence sequence_ = random_sequence(5);
};

TEST_F(FrameSinkTest, CachesReadBackBitForBitWhetherTheCountIsKnownOrNot) {
  for (const std::string name : {"back.pc2", "back.mdd"}) {
    for (const bool count_known : {true, false}) {
      EXPECT_THAT(write_all(folder_.path(name), sequence_, count_known),
                  ElementsAre(folder_.path("back.obj"), folder_.path(name)));
      const OpenedSource opened = open_source({{folder_.path("back.obj"), folder_.path(name)}, {}});
      EXPECT_EQ(opened.source->mesh(), sequence_.mesh);
      EXPECT_EQ(opened.source->metadata().at("name"), "ball");
      if (name == "back.mdd") {
        EXPECT_EQ(opened.source->metadata().at("fps"), "24");
      }
      expect_same_bits(read_all(*opened.source).frames, sequence_.frames);
      folder_.write("mesh.obj", folder_.read("back.obj"));  // where no cache lies beside it
      expect_same_bits(read_all(*open_source({{folder_.path("mesh.obj")}, {}}).source).frames,
                       {sequence_.frames[0]});
    }
  }
  EXPECT_THAT(folder_.names(), ElementsAre("back.mdd", "back.obj", "back.pc2", "mesh.obj"));
}

TEST_F(FrameSinkTest, CorrectsTheHeaderWhereFewerOrMoreFramesCome) {
  for (const std::string name : {"back.pc2", "back.mdd"}) {
    std::string exact;
    for (const std::uint64_t announced : {5U, 9U, 2U, 0U}) {
      const auto sink = open_sink(folder_.path(name), {});
      sink->begin_mesh(sequence_.mesh, {}, sequence_.metadata, announced);
      for (const FramePositions& frame : sequence_.frames) sink->write_frame(frame);
      sink->finish();
      if (announced == 5) exact = folder_.read(name);
      EXPECT_EQ(folder_.read(name), exact) << name << " " << announced;
    }
  }
}

TEST_F(FrameSinkTest, SequencesReadBackBitForBit) {
  for (const std::string suffix : {"obj", "ply", "off"}) {
    for (const std::string pattern : {"%03d", "###"}) {
      const TemporaryFolder folder;
      const std::string path = folder.path("f_" + pattern + "." + suffix);
      EXPECT_EQ(write_all(path, sequence_, true).size(), 5U);
      EXPECT_THAT(folder.names(), ElementsAre("f_000." + suffix, "f_001." + suffix, "f_002." + suffix,
                                              "f_003." + suffix, "f_004." + suffix));
      const OpenedSource opened = open_source({{path}, {}});
      EXPECT_EQ(opened.source->mesh(), sequence_.mesh);
      expect_same_bits(read_all(*opened.source).frames, sequence_.frames);
    }
  }
}

TEST_F(FrameSinkTest, StlKeepsTheCornersOfFaces) {
  const auto sink = open_sink(folder_.path("f_%d.stl"), {});
  EXPECT_THAT(sink->notes(), ElementsAre(HasSubstr("order of vertices")));
  write_all(folder_.path("f_%d.stl"), sequence_, true);
  SourceSpec spec{{folder_.path("f_%d.stl")}, {}};
  spec.sequence.weld.value = 0;  // these coordinates are of every size there is
  const OpenedSource opened = open_source(spec);
  const Frames result = read_all(*opened.source);
  ASSERT_EQ(result.frames.size(), 5U);
  for (std::size_t frame = 0; frame < 5; ++frame) {
    for (std::size_t face = 0; face < sequence_.mesh.faces.size(); ++face) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t ours = 3 * std::size_t{sequence_.mesh.faces[face][corner]};
        const std::size_t theirs = 3 * std::size_t{opened.source->mesh().faces[face][corner]};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          ASSERT_EQ(sequence_.frames[frame][ours + axis], result.frames[frame][theirs + axis]);
        }
      }
    }
  }
}

TEST_F(FrameSinkTest, StlNormalsHaveUnitLengthOrAreZero) {
  Sequence triangles;
  triangles.mesh = {4, {{0, 1, 2}, {0, 1, 1}}};
  triangles.frames = {{0, 0, 0, 2, 0, 0, 0, 3, 0, 1, 1, 1}};
  write_all(folder_.path("t.stl"), triangles, true);
  const std::string bytes = folder_.read("t.stl");
  ASSERT_EQ(bytes.size(), 184U);
  float normals[6];
  std::memcpy(normals, bytes.data() + 84, 12);
  std::memcpy(normals + 3, bytes.data() + 134, 12);
  EXPECT_THAT(normals, ElementsAre(0, 0, 1, 0, 0, 0));
}

TEST_F(FrameSinkTest, PlainNameHoldsOneFrameAndBecomesASequenceForMore) {
  Sequence one = sequence_;
  one.frames.resize(1);
  for (const bool count_known : {true, false}) {
    const TemporaryFolder folder;
    EXPECT_THAT(write_all(folder.path("back.obj"), one, count_known), ElementsAre(folder.path("back.obj")));
    EXPECT_THAT(folder.names(), ElementsAre("back.obj"));
    const TemporaryFolder other;
    EXPECT_EQ(write_all(other.path("back.obj"), sequence_, count_known).size(), 5U);
    EXPECT_THAT(other.names(), ElementsAre("back_0000.obj", "back_0001.obj", "back_0002.obj", "back_0003.obj",
                                           "back_0004.obj"));
    expect_same_bits(read_all(*open_source({{other.path("back_%04d.obj")}, {}}).source).frames,
                     sequence_.frames);
  }
}

TEST_F(FrameSinkTest, NumbersStartWhereTheCallerSays) {
  SinkOptions options;
  options.first_number = 99;
  EXPECT_THAT(write_all(folder_.path("f_%02d.ply"), random_sequence(2), true, options),
              ElementsAre(folder_.path("f_99.ply"), folder_.path("f_100.ply")));
  EXPECT_EQ(open_source({{folder_.path("f_%02d.ply")}, {}}).source->frame_count(), 2U);
}

TEST_F(FrameSinkTest, ConnectivityMayChangeInSequencesAndNotInCaches) {
  Sequence other;
  other.mesh = {3, {{0, 1, 2}}};
  const FramePositions triangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto write_both = [&](const std::string& name) {
    const auto sink = open_sink(folder_.path(name), {});
    sink->begin_mesh(sequence_.mesh, {}, {}, {});
    sink->write_frame(sequence_.frames[0]);
    sink->begin_mesh(other.mesh, {}, {}, {});
    sink->write_frame(triangle);
    sink->finish();
  };
  write_both("f.obj");
  EXPECT_THAT(folder_.names(), ElementsAre("f_0000.obj", "f_0001.obj"));
  EXPECT_EQ(open_source({{folder_.path("f_0001.obj")}, {}}).source->mesh(), other.mesh);
  for (const std::string name : {"c.pc2", "c.mdd"}) {
    const ToolError error = thrown_by([&] { write_both(name); });
    EXPECT_EQ(error.status(), ExitStatus::kUsage);
    EXPECT_THAT(error.what(), HasSubstr("the mesh changes at frame 1"));
  }
  EXPECT_THAT(folder_.names(), ElementsAre("f_0000.obj", "f_0001.obj"));
}

TEST_F(FrameSinkTest, LeavesNothingBrokenWhereItIsNotFinished) {
  for (const std::string name : {"a.pc2", "a.mdd", "b.obj"}) {
    const auto sink = open_sink(folder_.path(name), {});
    sink->begin_mesh(sequence_.mesh, {}, {}, {});
    sink->write_frame(sequence_.frames[0]);
  }
  EXPECT_THAT(folder_.names(), IsEmpty());
  const auto sink = open_sink(folder_.path("c_%d.off"), {});
  sink->begin_mesh(sequence_.mesh, {}, {}, {});
  for (const FramePositions& frame : sequence_.frames) sink->write_frame(frame);
  EXPECT_EQ(sink->files().size(), 4U);
  EXPECT_EQ(thrown_by([&] {
              const auto empty = open_sink(folder_.path("d.pc2"), {});
              empty->begin_mesh(sequence_.mesh, {}, {}, {});
              empty->finish();
            }).status(),
            ExitStatus::kInvalidInput);
}

TEST_F(FrameSinkTest, DoesNotOverwriteAnotherProgramsMeshBesideACache) {
  folder_.write("back.obj", "# from elsewhere\nv 0 0 0\n");
  const ToolError error = thrown_by([&] { write_all(folder_.path("back.pc2"), sequence_, true); });
  EXPECT_EQ(error.status(), ExitStatus::kUsage);
  EXPECT_THAT(error.what(), HasSubstr("back.obj would get the mesh of"));
  SinkOptions options;
  options.mesh_beside_cache = false;
  EXPECT_THAT(write_all(folder_.path("back.pc2"), sequence_, true, options),
              ElementsAre(folder_.path("back.pc2")));
  EXPECT_EQ(folder_.read("back.obj"), "# from elsewhere\nv 0 0 0\n");
}

TEST_F(FrameSinkTest, RefusesNamesItCannotServe) {
  EXPECT_THAT(thrown_by([&] { open_sink(folder_.path("a.fbx"), {}); }).what(),
              HasSubstr("suffix that cannot be written"));
  EXPECT_THAT(thrown_by([&] { open_sink(folder_.path(""), {}); }).what(), HasSubstr("/frame_%04d.obj"));
  EXPECT_EQ(thrown_by([&] { open_sink(folder_.path("none/a.pc2"), {}); }).status(), ExitStatus::kIo);
}

/// Standard output caught in a pipe for as long as it lives.
class StandardOutput {
 public:
  StandardOutput() : saved_(dup(STDOUT_FILENO)) {
    int ends[2];
    if (pipe(ends) != 0) std::abort();
    dup2(ends[1], STDOUT_FILENO);
    close(ends[1]);
    reader_ = std::thread([this, end = ends[0]] {
      char block[4096];
      for (ssize_t got = 0; (got = ::read(end, block, sizeof block)) > 0;) {
        bytes_.append(block, static_cast<std::size_t>(got));
      }
      close(end);
    });
  }
  ~StandardOutput() { stop(); }
  StandardOutput(const StandardOutput&) = delete;
  StandardOutput& operator=(const StandardOutput&) = delete;

  const std::string& stop() {
    if (reader_.joinable()) {
      dup2(saved_, STDOUT_FILENO);
      close(saved_);
      reader_.join();
    }
    return bytes_;
  }

 private:
  int saved_;
  std::string bytes_;
  std::thread reader_;
};

TEST_F(FrameSinkTest, WritesPc2ToStandardOutputWhereTheCountIsKnown) {
  write_all(folder_.path("back.pc2"), sequence_, true);
  StandardOutput output;
  write_all("-", sequence_, true);
  EXPECT_EQ(output.stop(), folder_.read("back.pc2"));
}

TEST_F(FrameSinkTest, RefusesStandardOutputWhereTheCountIsUnknownOrWrong) {
  StandardOutput output;
  const ToolError unknown = thrown_by([&] { write_all("-", sequence_, false); });
  EXPECT_EQ(unknown.status(), ExitStatus::kUsage);
  EXPECT_THAT(unknown.what(), HasSubstr("begins with its number of frames"));
  const ToolError wrong = thrown_by([&] {
    const auto sink = open_sink("-", {});
    sink->begin_mesh(sequence_.mesh, {}, {}, 9);
    sink->write_frame(sequence_.frames[0]);
    sink->finish();
  });
  EXPECT_THAT(wrong.what(), HasSubstr("standard output: 9 frames were announced in the header, but 1"));
}

TEST_F(FrameSinkTest, ReportsAFullDiskAndRemovesWhatItWrote) {
  struct rlimit saved {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &saved), 0);
  struct rlimit small = saved;
  small.rlim_cur = 1000;
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::vector<ToolError> errors;
  for (const std::string name : {"a.pc2", "a.mdd", "a_%d.obj"}) {
    errors.push_back(thrown_by([&] { write_all(folder_.path(name), sequence_, true); }));
  }
  setrlimit(RLIMIT_FSIZE, &saved);
  std::signal(SIGXFSZ, old_handler);
  for (const ToolError& error : errors) {
    EXPECT_EQ(error.status(), ExitStatus::kIo);
    EXPECT_THAT(error.what(), HasSubstr("cannot write " + folder_.path("a")));
    EXPECT_THAT(error.what(), HasSubstr("File too large"));
  }
  EXPECT_THAT(folder_.names(), IsEmpty());
}

TEST(RealData, ReadsBackBitForBitThroughEveryFormat) {
  const std::string data = data_folder();
  if (data.empty()) GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  const TemporaryFolder folder;
  const OpenedSource original = open_source({{data + "/cow.obj", data + "/cow.pc2"}, FrameRange{0, 4}});
  Sequence sequence{original.source->mesh(), read_all(*original.source).frames, original.source->metadata()};
  for (const std::string name : {"b.pc2", "b.mdd", "o_%d.obj", "p_%d.ply", "q_%d.off"}) {
    write_all(folder.path(name), sequence, true);
    std::vector<std::string> inputs = {folder.path(name)};
    if (name[0] == 'b') inputs.push_back(folder.path("b.obj"));
    const OpenedSource opened = open_source({inputs, {}});
    EXPECT_EQ(opened.source->mesh(), sequence.mesh);
    expect_same_bits(read_all(*opened.source).frames, sequence.frames);
  }
}

}  // namespace
}  // namespace tvg::cli
