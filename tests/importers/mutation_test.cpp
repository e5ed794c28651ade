#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/open_source.hpp"
#include "tests/importers/sample_files.hpp"

#include <gtest/gtest.h>
#include <random>

namespace tvg::cli {
namespace {

using namespace testing;
using Parser = void (*)(const std::string&, std::string_view, MeshFile&);

/// One to four changes: a byte replaced, a stretch removed or doubled, or a run of digits put in.
std::string mutated(const std::string& original, std::mt19937& random) {
  std::string bytes = original;
  const auto below = [&](std::size_t limit) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(limit, 1));
  };
  const std::size_t changes = 1 + below(4);
  for (std::size_t change = 0; change < changes && !bytes.empty(); ++change) {
    const std::size_t place = below(bytes.size());
    const std::size_t length = below(std::min<std::size_t>(24, bytes.size() - place) + 1);
    switch (below(5)) {
      case 0:
        bytes[place] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(place, length);
        break;
      case 2:
        bytes.insert(place, bytes.substr(place, length));
        break;
      case 3:
        bytes[place] = "0123456789-+.eE/\\ \n\r#"[below(21)];
        break;
      default:
        bytes.insert(place, std::to_string(random()));
        break;
    }
  }
  return bytes;
}

/// What every reader promises of a mesh it accepts.
void expect_sound(const MeshFile& mesh) {
  EXPECT_FALSE(mesh.faces.empty());
  EXPECT_EQ(mesh.positions.size() % 3, 0U);
  EXPECT_EQ(find_non_finite(mesh.positions), mesh.positions.size());
  for (const Face& face : mesh.faces) {
    for (const std::uint32_t index : face) EXPECT_LT(index, mesh.vertex_count());
  }
}

void expect_survives_mutations(Parser parser, const std::string& bytes) {
  std::mt19937 random(1);
  for (int round = 0; round < 4000; ++round) {
    const std::string text = mutated(bytes, random);
    const std::vector<char> exact(text.begin(), text.end());
    MeshFile mesh;
    try {
      parser("mutated", {exact.data(), exact.size()}, mesh);
      expect_sound(mesh);
    } catch (const ImportError&) {
      continue;
    }
  }
}

TEST(Mutation, ObjNeverCrashesAndNeverYieldsAnUnsoundMesh) {
  expect_survives_mutations(parse_obj, sample_obj());
}
TEST(Mutation, OffNeverCrashesAndNeverYieldsAnUnsoundMesh) {
  expect_survives_mutations(parse_off, sample_off());
}
TEST(Mutation, PlyNeverCrashesAndNeverYieldsAnUnsoundMesh) {
  expect_survives_mutations(parse_ply, sample_ply_ascii());
  expect_survives_mutations(parse_ply, sample_ply_binary(false));
  expect_survives_mutations(parse_ply, sample_ply_binary(true));
}
TEST(Mutation, StlNeverCrashesAndNeverYieldsAnUnsoundMesh) {
  expect_survives_mutations(parse_stl, sample_stl_ascii());
  expect_survives_mutations(parse_stl, sample_stl_binary(tetrahedron_positions(0)));
}

TEST(Mutation, CachesNeverCrashAndNeverYieldMoreFramesThanTheyHold) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("t.obj", sample_obj());
  std::mt19937 random(2);
  for (const std::string& bytes : {pc2_bytes(4, 3, 3), mdd_bytes(4, 3, 3, 0.04)}) {
    for (int round = 0; round < 200; ++round) {
      const std::string cache = folder.write("t.mdd", mutated(bytes, random));
      try {
        const OpenedSource opened = open_source({{mesh, cache}, {}});
        const Frames result = read_all(*opened.source);
        EXPECT_LE(result.frames.size(), 12U);
        EXPECT_TRUE(result.error || result.frames.size() == opened.source->frame_count());
      } catch (const ToolError&) {
        continue;
      }
    }
  }
}

}  // namespace
}  // namespace tvg::cli
