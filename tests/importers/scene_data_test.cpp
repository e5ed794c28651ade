#include "base/checksum.hpp"
#include "encoder/importers/open_source.hpp"
#include "encoder/importers/scene_summary.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

// Real scenes, from packages that corpus/manifest.md names. What is not there is skipped.
namespace tvg::cli {
namespace {

using namespace testing;

struct RealFile {
  std::string package, version, file, digest;
  std::uint64_t bytes = 0;
};

/// The folder of a package's files: an environment variable, or where Debian puts them.
std::string package_folder(const std::string& package) {
  const bool debian = package == "assimp-testmodels";
  const char* variable = std::getenv(debian ? "TVG_ASSIMP_MODELS" : "TVG_CESIUMJS");
  if (variable != nullptr) return variable;
  return debian ? "/usr/share/assimp/models" : "";
}

std::string path_of(const std::string& package, const std::string& file) {
  const std::string path = package_folder(package) + "/" + file;
  return std::filesystem::is_regular_file(path) ? path : "";
}

std::string absent(const std::string& package, const std::string& file) {
  return package == "assimp-testmodels" ? file +
                                              " of Debian's package assimp-testmodels is not installed "
                                              "(TVG_ASSIMP_MODELS may name its folder)"
                                        : file + " of the npm package " + package +
                                              ": TVG_CESIUMJS has to name the folder it is unpacked in";
}

std::vector<RealFile> manifest() {
  std::ifstream file(TVG_CORPUS_MANIFEST);
  std::vector<RealFile> rows;
  for (std::string line; std::getline(file, line);) {
    for (char& c : line) c = c == '|' ? ' ' : c;
    std::istringstream cells(line);
    RealFile row;
    const bool complete = bool{cells >> row.package >> row.version >> row.file >> row.bytes >> row.digest};
    if (complete && row.digest.size() == 16 && row.file.find('/') != std::string::npos) rows.push_back(row);
  }
  return rows;
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Edges with one face only: none in a closed mesh.
std::size_t border_edges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const Face& face : mesh.faces) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      ++uses[std::minmax(face[corner], face[(corner + 1) % 3])];
    }
  }
  return static_cast<std::size_t>(
      std::count_if(uses.begin(), uses.end(), [](const auto& entry) { return entry.second == 1; }));
}

struct Expected {
  const char* package;
  const char* file;
  std::uint32_t vertices;
  std::size_t faces;
  std::uint64_t frames;
  std::size_t joints;
  double diagonal;  // of the first frame, to three digits
};

class RealScene : public ::testing::TestWithParam<Expected> {};

TEST_P(RealScene, BakesWithItsSkeletonInsideTheMesh) {
  const Expected& expected = GetParam();
  const std::string path = path_of(expected.package, expected.file);
  if (path.empty()) GTEST_SKIP() << absent(expected.package, expected.file);
  const OpenedSource opened = open_source({{path}});
  FrameSource& source = *opened.source;
  EXPECT_EQ(source.mesh().vertex_count, expected.vertices);
  EXPECT_EQ(source.mesh().faces.size(), expected.faces);
  EXPECT_EQ(source.frame_count(), expected.frames);
  const Skeleton& skeleton = source.skeleton();
  EXPECT_EQ(skeleton.joint_names.size(), expected.joints);
  for (std::size_t joint = 0; joint < skeleton.parents.size(); ++joint) {
    EXPECT_LT(skeleton.parents[joint], static_cast<std::int32_t>(joint));
  }
  for (const std::uint32_t joint : skeleton.heaviest_joint) ASSERT_LT(joint, expected.joints);

  FramePositions positions(3 * std::size_t{expected.vertices});
  std::uint64_t frames = 0;
  for (; *source.read_frame(positions); ++frames) {
    double squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float low = positions[axis], high = positions[axis];
      for (std::size_t i = axis; i < positions.size(); i += 3) {
        low = std::min(low, positions[i]);
        high = std::max(high, positions[i]);
      }
      squares += double{high - low} * double{high - low};
      // A rig's joints lie within the body, give or take hair, tails and IK handles.
      const float room = 0.25F * (high - low) + 1e-3F;
      for (std::size_t i = axis; i < source.joint_positions().size(); i += 3) {
        EXPECT_GE(source.joint_positions()[i], low - room) << "frame " << frames << " joint " << i / 3;
        EXPECT_LE(source.joint_positions()[i], high + room) << "frame " << frames << " joint " << i / 3;
      }
    }
    if (frames == 0) {
      EXPECT_NEAR(std::sqrt(squares), expected.diagonal, 0.01 * expected.diagonal);
    }
  }
  EXPECT_EQ(frames, expected.frames);
}

void PrintTo(const Expected& expected, std::ostream* out) {
  *out << expected.file;
}

INSTANTIATE_TEST_SUITE_P(
    Packages, RealScene,
    ::testing::Values(
        Expected{"assimp-testmodels", "X/Testwuson.X", 2124, 3732, 30, 37, 3.243},
        Expected{"assimp-testmodels", "X/BCN_Epileptic.X", 2633, 5126, 100, 54, 1.944},
        Expected{"assimp-testmodels", "MD2/faerie.md2", 366, 654, 198, 0, 61.57},
        Expected{"assimp-testmodels", "MD2/sydney.md2", 342, 679, 198, 0, 60.69},
        Expected{"assimp-testmodels", "FBX/animation_with_skeleton.fbx", 1058, 2112, 26, 14, 7126},
        Expected{"cesiumjs", "Apps/SampleData/models/CesiumMan/Cesium_Man.dae", 2338, 4672, 61, 19, 1.795}),
    [](const auto& instance) { return std::filesystem::path(instance.param.file).stem().string(); });

TEST(RealSceneFiles, AreThoseOfTheManifest) {
  const std::vector<RealFile> rows = manifest();
  EXPECT_GE(rows.size(), 8U);
  std::string missing;
  for (const RealFile& row : rows) {
    const std::string path = path_of(row.package, row.file);
    if (path.empty()) {
      missing.append("\n").append(absent(row.package, row.file));
      continue;
    }
    const std::string bytes = contents(path);
    Hasher hasher;
    hasher.update(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    char digest[17];
    std::snprintf(digest, sizeof digest, "%016llx", static_cast<unsigned long long>(hasher.value()));
    EXPECT_EQ(bytes.size(), row.bytes) << row.file;
    EXPECT_EQ(digest, row.digest) << row.file;
  }
  if (!missing.empty()) GTEST_SKIP() << missing;
}

TEST(RealSceneFiles, AreClosedOnceWelded) {
  const std::string path = path_of("cesiumjs", "Apps/SampleData/models/CesiumMan/Cesium_Man.dae");
  if (path.empty()) GTEST_SKIP() << absent("cesiumjs", "Apps/SampleData/models/CesiumMan/Cesium_Man.dae");
  EXPECT_EQ(border_edges(open_source({{path}}).source->mesh()), 0U);
}

TEST(RealSceneFiles, GiveAMessageOrFramesWhereverTheyAreCut) {
  TemporaryFolder folder;
  std::size_t tried = 0, refused = 0;
  for (const std::string file :
       {"X/Testwuson.X", "FBX/huesitos.fbx", "MD2/faerie.md2", "MD5/SimpleCube.md5mesh",
        "glTF2/simple_skin/simple_skin.gltf", "Collada/box_nested_animation.dae"}) {
    const std::string path = path_of("assimp-testmodels", file);
    if (path.empty()) GTEST_SKIP() << absent("assimp-testmodels", file);
    const std::string bytes = contents(path);
    for (std::size_t part = 1; part < 12; ++part) {
      const std::string cut =
          folder.write(std::filesystem::path(file).filename(), bytes.substr(0, part * bytes.size() / 12));
      ++tried;
      try {
        const OpenedSource opened = open_source({{cut}});
        FramePositions positions(3 * std::size_t{opened.source->mesh().vertex_count});
        while (true) {
          const Result<bool> read = opened.source->read_frame(positions);
          if (!read || !*read) break;
        }
      } catch (const ToolError& error) {
        ++refused;
        EXPECT_EQ(error.status(), ExitStatus::kInvalidInput) << error.what();
        EXPECT_THAT(error.what(), ::testing::HasSubstr(cut));
      }
    }
  }
  EXPECT_EQ(tried, 66U);
  EXPECT_GT(refused, 50U);
}

}  // namespace
}  // namespace tvg::cli
