#include "connectivity/mesh_coder_encode.hpp"
#include "container/mesh_payload.hpp"
#include "corpus/corpus.hpp"
#include "planes/reference_shape_encode.hpp"
#include "tests/connectivity/mesh_builders.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace tvg {
namespace {

using namespace tvg::test;

using Section = std::vector<std::uint8_t>;

/// Anywhere on the lattice; `calm` keeps to within a few steps of the middle.
ReferenceShape random_shape(std::uint32_t vertex_count, int bits, bool calm, std::mt19937& random) {
  ReferenceShape shape;
  shape.origin = {-1.5, 1e300, -0.0};
  shape.step = 0x1p-9;
  shape.bits = bits;
  shape.neighbours = 4 + static_cast<std::uint32_t>(random() % 13);
  shape.indices.resize(vertex_count);
  const auto last = static_cast<std::int32_t>((1u << bits) - 1);
  for (auto& position : shape.indices) {
    for (std::int32_t& index : position) {
      const auto any = static_cast<std::int32_t>(random() & 0xFFFFFF);
      index = calm ? std::clamp(last / 2 + any % 9 - 4, 0, last) : any & last;
    }
  }
  return shape;
}

/// The smallest lattice of `bits` bits over `box`, and the positions of `frame` on it in the order of a
/// traversal.
ReferenceShape shape_of(const FramePositions& frame, const FramePositions& box,
                        const std::vector<std::uint32_t>& order, int bits) {
  ReferenceShape shape;
  shape.bits = bits;
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = box[k], high = box[k];
    for (std::size_t i = k; i < box.size(); i += 3) {
      low = std::min<double>(low, box[i]);
      high = std::max<double>(high, box[i]);
    }
    shape.origin[k] = low;
    extent = std::max(extent, high - low);
  }
  const int last = (1 << bits) - 1;
  shape.step = extent / last;
  shape.indices.resize(order.size());
  for (std::size_t t = 0; t < order.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = (frame[std::size_t{3} * order[t] + k] - shape.origin[k]) / shape.step;
      shape.indices[t][k] = std::clamp(static_cast<int>(std::lround(x)), 0, last);
    }
  }
  return shape;
}

Section expect_round_trip(const ReferenceShape& shape, const std::vector<Face>& faces) {
  Section section = encode_reference_shape(shape, faces);
  const auto decoded =
      decode_reference_shape(section, faces, static_cast<std::uint32_t>(shape.indices.size()));
  EXPECT_TRUE(decoded) << (decoded ? "" : decoded.error().describe());
  if (decoded) {
    EXPECT_EQ(*decoded, shape);
  }
  return section;
}

double bits_per_coordinate(const Section& section, std::uint32_t vertex_count) {
  return 8.0 * static_cast<double>(section.size()) / (3.0 * vertex_count);
}

/// Damaged or not, what is given out lies on its lattice.
void expect_refused_or_valid(const Section& section, const std::vector<Face>& faces,
                             std::uint32_t vertex_count) {
  const auto decoded = decode_reference_shape(section, faces, vertex_count);
  if (!decoded) {
    EXPECT_EQ(decoded.error().code, ErrorCode::kMalformed);
    EXPECT_STREQ(decoded.error().section, "§5.3");
    return;
  }
  ASSERT_EQ(decoded->indices.size(), vertex_count);
  for (const auto& position : decoded->indices) {
    for (const std::int32_t index : position) ASSERT_EQ(index >> decoded->bits, 0);
  }
}

TEST(ReferenceShape, ComesBackOnEveryMeshAndLattice) {
  std::mt19937 random(1);
  for (const NamedMesh& named : all_sorts_of_meshes()) {
    for (const int bits : {1, 2, 9, 13, 24}) {
      for (const bool calm : {false, true}) {
        SCOPED_TRACE(named.name + ", " + std::to_string(bits) + " bits");
        expect_round_trip(random_shape(named.mesh.vertex_count, bits, calm, random), named.mesh.faces);
      }
    }
  }
}

TEST(ReferenceShape, DoesNotDependOnTheOrderOfFacesAndCorners) {
  std::mt19937 random(2);
  for (const NamedMesh& named : all_sorts_of_meshes()) {
    std::vector<Face> faces = named.mesh.faces;
    std::shuffle(faces.begin(), faces.end(), random);
    for (Face& face : faces) std::shuffle(face.begin(), face.end(), random);
    const ReferenceShape shape = random_shape(named.mesh.vertex_count, 10, true, random);
    EXPECT_EQ(encode_reference_shape(shape, named.mesh.faces), encode_reference_shape(shape, faces))
        << named.name;
  }
}

TEST(ReferenceShape, BothSidesOfAMeshHaveTheSameFacesForIt) {
  for (const corpus::CorpusEntry& entry : corpus::corpus_entries()) {
    const Sequence sequence = entry.make({1500, 1}).sequence;
    for (const bool keep_order : {true, false}) {
      SCOPED_TRACE(std::string(entry.name));
      EncodedMesh encoded = encode_mesh(sequence.mesh, keep_order);
      const std::vector<std::uint8_t> payload = mesh_payload(encoded);
      const auto layout = read_mesh(payload);
      ASSERT_TRUE(layout);
      const auto decoded = decode_mesh(*layout, encoded.coded.id);
      ASSERT_TRUE(decoded);
      const auto here = faces_by_traversal(encoded.coded), there = faces_by_traversal(*decoded);
      ASSERT_TRUE(here && there);
      const ReferenceShape shape = shape_of(sequence.frames[0], sequence.frames[0], encoded.coded.order, 11);
      const auto back =
          decode_reference_shape(encode_reference_shape(shape, *here), *there, sequence.mesh.vertex_count);
      ASSERT_TRUE(back);
      EXPECT_EQ(*back, shape);
    }
  }
}

TEST(ReferenceShape, SmoothSurfacesTakeLittle) {
  for (const auto& [name, most] : {std::pair{"cloth", 2.5}, {"hand", 2.7}, {"face", 2.2}}) {
    const Sequence sequence = corpus::find_corpus_entry(name)->make({6000, 1}).sequence;
    const EncodedMesh encoded = encode_mesh(sequence.mesh, true);
    const ReferenceShape shape = shape_of(sequence.frames[0], sequence.frames[0], encoded.coded.order, 11);
    const Section section = expect_round_trip(shape, *faces_by_traversal(encoded.coded));
    EXPECT_LT(bits_per_coordinate(section, sequence.mesh.vertex_count), most) << name;
  }
}

TEST(ReferenceShape, HubsAreNoHarderThanOtherVertices) {
  std::mt19937 random(3);
  Mesh fan{20000, {}}, book{20000, {}};
  for (std::uint32_t v = 2; v < 20000; ++v) {
    fan.faces.push_back({0, v - 1, v});
    book.faces.push_back({0, 1, v});
  }
  for (const Mesh& mesh : {fan, book}) {
    for (const int bits : {11, 24})
      expect_round_trip(random_shape(mesh.vertex_count, bits, false, random), mesh.faces);
  }
  // Sums over many corners of the lattice stay within what holds them.
  for (const std::int32_t corner : {0, (1 << 24) - 1}) {
    ReferenceShape shape = random_shape(fan.vertex_count, 24, false, random);
    for (std::size_t v = 0; v < shape.indices.size(); ++v) {
      if (v % 3 != 0) shape.indices[v] = {corner, (1 << 24) - 1 - corner, corner};
    }
    expect_round_trip(shape, fan.faces);
    expect_round_trip(shape, shuffled(grid(199, 99), random).faces);
  }
}

TEST(ReferenceShape, EveryTruncationAndEveryAddedByteIsMalformed) {
  std::mt19937 random(4);
  const Mesh mesh = closed_surface(8, 4);
  const Section section = expect_round_trip(random_shape(mesh.vertex_count, 11, false, random), mesh.faces);
  for (std::size_t size = 0; size < section.size(); ++size) {
    const auto decoded =
        decode_reference_shape(Section(section.begin(), section.begin() + static_cast<std::ptrdiff_t>(size)),
                               mesh.faces, mesh.vertex_count);
    ASSERT_FALSE(decoded) << size;
    EXPECT_EQ(decoded.error().code, ErrorCode::kMalformed);
    EXPECT_STREQ(decoded.error().section, "§5.3");
  }
  for (const int added : {0, 1, 255}) {
    Section longer = section;
    longer.push_back(static_cast<std::uint8_t>(added));
    EXPECT_FALSE(decode_reference_shape(longer, mesh.faces, mesh.vertex_count));
  }
}

TEST(ReferenceShape, EveryChangedByteIsRefusedOrYieldsAShape) {
  std::mt19937 random(5);
  const Mesh mesh = joined(closed_surface(6, 3), random_soup(6, 12, random));
  for (const int bits : {3, 24}) {
    const Section section =
        expect_round_trip(random_shape(mesh.vertex_count, bits, bits == 3, random), mesh.faces);
    for (std::size_t at = 0; at < section.size(); ++at) {
      for (int change = 1; change < 256; ++change) {
        Section damaged = section;
        damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ change);
        expect_refused_or_valid(damaged, mesh.faces, mesh.vertex_count);
      }
    }
  }
}

TEST(ReferenceShape, RandomBytesOnAnyMeshAreRefusedOrYieldAShape) {
  std::mt19937 random(6);
  for (const NamedMesh& named : all_sorts_of_meshes()) {
    for (int round = 0; round < 8; ++round) {
      Section section =
          encode_reference_shape(random_shape(0, 1 + static_cast<int>(random() % 24), true, random), {});
      section.resize(34);
      for (std::size_t i = random() % 300; i > 0; --i)
        section.push_back(round % 4 == 0 ? 0xFF : static_cast<std::uint8_t>(random()));
      expect_refused_or_valid(section, named.mesh.faces, named.mesh.vertex_count);
    }
  }
}

TEST(ReferenceShape, FieldsOutsideTheirRangeAreMalformed) {
  std::mt19937 random(7);
  const Mesh mesh = tetrahedron();
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const auto refused = [&](const auto& change) {
    ReferenceShape shape = random_shape(4, 8, false, random);
    const Section section = encode_reference_shape(shape, mesh.faces);
    change(shape);
    Section head = encode_reference_shape(shape, mesh.faces);
    head.resize(34);
    head.insert(head.end(), section.begin() + 34, section.end());
    const auto decoded = decode_reference_shape(head, mesh.faces, 4);
    return !decoded && decoded.error().code == ErrorCode::kMalformed &&
           std::strcmp(decoded.error().section, "§5.3") == 0;
  };
  EXPECT_FALSE(refused([](ReferenceShape&) {}));
  for (const std::uint32_t neighbours : {0u, 3u, 17u, 255u})
    EXPECT_TRUE(refused([=](ReferenceShape& shape) { shape.neighbours = neighbours; }));
  for (const double step : {0.0, -1.0, infinity, nan})
    EXPECT_TRUE(refused([=](ReferenceShape& shape) { shape.step = step; }));
  for (const double x : {infinity, -infinity, nan})
    EXPECT_TRUE(refused([=](ReferenceShape& shape) { shape.origin[2] = x; }));
  for (const int bits : {0, 25, 255}) {
    Section section = encode_reference_shape(random_shape(4, 8, false, random), mesh.faces);
    section[0] = static_cast<std::uint8_t>(bits);
    EXPECT_FALSE(decode_reference_shape(section, mesh.faces, 4));
  }
}

TEST(ReferenceShape, WorkIsInProportionToTheBytes) {
  Section section = encode_reference_shape(ReferenceShape{}, {});
  section.resize(40);
  EXPECT_FALSE(decode_reference_shape(section, {}, 3'000'000));
}

/// Faces of an OBJ file of triangles.
Mesh read_faces(const std::filesystem::path& path) {
  std::ifstream file(path);
  Mesh mesh;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") ++mesh.vertex_count;
    if (word != "f") continue;
    Face face;
    for (std::uint32_t& v : face) {
      words >> word;
      v = static_cast<std::uint32_t>(std::stoul(word)) - 1;
    }
    mesh.faces.push_back(face);
  }
  return mesh;
}

/// All frames of a PC2 file, one after the other.
FramePositions read_positions(const std::filesystem::path& path) {
  constexpr std::size_t kHead = 32;
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || size < kHead) return {};
  FramePositions positions((size - kHead) / sizeof(float));
  std::ifstream file(path, std::ios::binary);
  file.seekg(kHead);
  file.read(reinterpret_cast<char*>(positions.data()),
            static_cast<std::streamsize>(positions.size() * sizeof(float)));
  return positions;
}

TEST(ReferenceShape, RealMeshesStayWithinTheirBitsPerCoordinate) {
  const char* const variable = std::getenv("TVG_DATA_DIR");
  const std::filesystem::path folder = variable != nullptr ? variable : "";
  if (folder.empty()) GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  struct Bound {
    const char* name;
    std::array<double, 5> most;  ///< at 9 to 13 bits
  };
  for (const auto& [name, most] : {Bound{"chicken", {1.63, 2.22, 3.01, 3.91, 4.89}},
                                   {"cow", {2.57, 3.46, 4.43, 5.44, 6.43}},
                                   {"dance", {1.64, 2.17, 2.84, 3.65, 4.55}},
                                   {"crane", {2.58, 3.51, 4.51, 5.51, 6.52}},
                                   {"horse-gallop", {2.19, 2.99, 3.89, 4.86, 5.84}}}) {
    const Mesh mesh = read_faces(folder / (std::string(name) + ".obj"));
    const FramePositions positions = read_positions(folder / (std::string(name) + ".pc2"));
    if (positions.size() < std::size_t{3} * mesh.vertex_count || mesh.faces.empty())
      GTEST_SKIP() << "no " << name << " in " << folder;
    const EncodedMesh encoded = encode_mesh(mesh, true);
    const std::vector<Face> faces = *faces_by_traversal(encoded.coded);
    for (std::size_t i = 0; i < most.size(); ++i) {
      const ReferenceShape shape =
          shape_of(positions, positions, encoded.coded.order, 9 + static_cast<int>(i));
      EXPECT_LT(bits_per_coordinate(expect_round_trip(shape, faces), mesh.vertex_count), most[i])
          << name << " at " << shape.bits;
    }
  }
}

}  // namespace
}  // namespace tvg
