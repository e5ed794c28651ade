#include "connectivity/connectivity.hpp"

#include "connectivity/connectivity_encode.hpp"
#include "mesh_builders.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <sstream>

namespace tvg {
namespace {

std::uint32_t face_count(const Mesh& mesh) {
  return static_cast<std::uint32_t>(mesh.faces.size());
}

/// The faces as a sorted list in which neither order nor first corner tells, but winding does.
std::vector<Face> canonical(std::vector<Face> faces) {
  for (Face& face : faces) {
    Face least = face;
    for (int i = 0; i < 2; ++i) {
      std::rotate(face.begin(), face.begin() + 1, face.end());
      least = std::min(least, face);
    }
    face = least;
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<Face> in_mesh_order(const EncodedConnectivity& encoded) {
  std::vector<Face> faces = encoded.connectivity.faces;
  for (Face& face : faces) {
    for (std::uint32_t& v : face) v = encoded.order[v];
  }
  return faces;
}

void expect_well_formed(const std::vector<Gate>& gates) {
  for (std::uint32_t v = 0; v < gates.size(); ++v) {
    const Gate& gate = gates[v];
    EXPECT_TRUE(gate.n < v || gate == Gate{});
    EXPECT_TRUE(gate.p == kNoVertex || (gate.p < v && gate.p != gate.n));
    EXPECT_TRUE(gate.o == kNoVertex ||
                (gate.o < v && gate.p != kNoVertex && gate.o != gate.n && gate.o != gate.p));
  }
}

void expect_round_trip(const Mesh& mesh) {
  const EncodedConnectivity encoded = encode_connectivity(mesh);
  const auto decoded = decode_connectivity(encoded.bytes, mesh.vertex_count, face_count(mesh));
  ASSERT_TRUE(decoded) << decoded.error().describe();
  EXPECT_TRUE(*decoded == encoded.connectivity);
  std::vector<std::uint32_t> order = encoded.order;
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), mesh.vertex_count);
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) ASSERT_EQ(order[v], v);
  EXPECT_EQ(canonical(in_mesh_order(encoded)), canonical(mesh.faces));
  expect_well_formed(decoded->gates);
}

TEST(Connectivity, RoundTripKeepsFacesAndWindingOfEverySortOfMesh) {
  for (const test::NamedMesh& named : test::all_sorts_of_meshes()) {
    SCOPED_TRACE(named.name);
    expect_round_trip(named.mesh);
  }
}

TEST(Connectivity, RoundTripOfRandomSoups) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const auto vertices = static_cast<std::uint32_t>(1 + random() % 60);
    Mesh mesh = test::random_soup(vertices, random() % 80, random);
    if (i % 3 == 0)
      mesh = test::joined(mesh, test::with_flips(test::grid(6, 6, i % 2 == 0, i % 5 == 0), 0.2, random));
    if (i % 4 == 0) mesh = test::with_holes(test::with_duplicates(mesh, 20, random), 0.2, random);
    expect_round_trip(test::shuffled(mesh, random));
  }
}

TEST(Connectivity, GatesLeadOverTheTriangleAcross) {
  const EncodedConnectivity encoded = encode_connectivity(test::closed_surface(30, 20));
  std::size_t complete = 0;
  for (std::uint32_t v = 0; v < encoded.connectivity.gates.size(); ++v) {
    const Gate& gate = encoded.connectivity.gates[v];
    if (gate.o == kNoVertex) continue;
    ++complete;
    const auto has = [&](const Face& wanted) {
      const std::vector<Face> faces = canonical(encoded.connectivity.faces);
      return std::binary_search(faces.begin(), faces.end(), canonical({wanted}).front());
    };
    EXPECT_TRUE(has({gate.n, gate.p, gate.o}));
    EXPECT_TRUE(has({gate.p, gate.n, v}));
  }
  EXPECT_EQ(complete, encoded.connectivity.gates.size() - 3);
}

TEST(Connectivity, RegularSurfaceCostsLessThanHalfABitPerVertex) {
  for (const Mesh& mesh :
       {test::grid(60, 60, true, true), test::closed_surface(60, 60), test::grid(60, 60)}) {
    EXPECT_LT(8.0 * static_cast<double>(encode_connectivity(mesh).bytes.size()), 0.5 * mesh.vertex_count);
  }
}

TEST(Connectivity, EveryMeshStaysWithinTheElementsPerByte) {
  for (const Mesh& mesh : {Mesh{100000, {}}, test::grid(200, 200, true, true), test::grid(1, 20000)}) {
    const EncodedConnectivity encoded = encode_connectivity(mesh);
    EXPECT_LE(mesh.vertex_count + mesh.faces.size(), kMaxElementsPerByte * encoded.bytes.size());
    expect_round_trip(mesh);
  }
}

TEST(Connectivity, DecoderRefusesCountsThatTheBytesCannotHoldBeforeAllocating) {
  const std::vector<std::uint8_t> bytes(10, 0x55);
  for (const auto& [vertices, faces] : {std::pair{0xFFFFFFFFu, 0u}, {0u, 0xFFFFFFFFu}, {640u, 641u}}) {
    const auto decoded = decode_connectivity(bytes, vertices, faces);
    ASSERT_FALSE(decoded);
    EXPECT_EQ(decoded.error().code, ErrorCode::kLimitExceeded);
    EXPECT_STREQ(decoded.error().section, "§5.1");
  }
  EXPECT_FALSE(decode_connectivity({}, 1, 0));
}

TEST(Connectivity, DecoderRefusesOtherCountsThanThoseEncoded) {
  const Mesh mesh = test::closed_surface(8, 6);
  const EncodedConnectivity encoded = encode_connectivity(mesh);
  EXPECT_FALSE(decode_connectivity(encoded.bytes, mesh.vertex_count - 1, face_count(mesh)));
  EXPECT_FALSE(decode_connectivity(encoded.bytes, mesh.vertex_count, face_count(mesh) - 1));
  EXPECT_FALSE(decode_connectivity(encoded.bytes, mesh.vertex_count, face_count(mesh) + 1));
}

Mesh small_mesh() {
  std::mt19937 random(3);
  return test::joined(test::with_flips(test::closed_surface(6, 4), 0.1, random),
                      test::random_soup(9, 8, random));
}

TEST(Connectivity, DecoderRejectsEveryTruncation) {
  const Mesh mesh = small_mesh();
  const EncodedConnectivity encoded = encode_connectivity(mesh);
  for (std::size_t length = 0; length < encoded.bytes.size(); ++length) {
    const auto exact = std::make_unique<std::uint8_t[]>(length);  // so that a sanitizer sees one byte too far
    std::copy_n(encoded.bytes.begin(), length, exact.get());
    EXPECT_FALSE(decode_connectivity({exact.get(), length}, mesh.vertex_count, face_count(mesh))) << length;
  }
}

TEST(Connectivity, DecoderRejectsBytesBehindTheEnd) {
  const Mesh mesh = small_mesh();
  std::vector<std::uint8_t> bytes = encode_connectivity(mesh).bytes;
  bytes.push_back(0);
  EXPECT_FALSE(decode_connectivity(bytes, mesh.vertex_count, face_count(mesh)));
}

TEST(Connectivity, EverySingleByteChangeGivesAnErrorOrAWellFormedMesh) {
  const Mesh mesh = small_mesh();
  const EncodedConnectivity encoded = encode_connectivity(mesh);
  for (std::size_t i = 0; i < encoded.bytes.size(); ++i) {
    for (unsigned change = 1; change < 256; ++change) {
      std::vector<std::uint8_t> bytes = encoded.bytes;
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ change);
      const auto decoded = decode_connectivity(bytes, mesh.vertex_count, face_count(mesh));
      if (!decoded) {
        ASSERT_EQ(decoded.error().code, ErrorCode::kMalformed);
        continue;
      }
      ASSERT_EQ(decoded->gates.size(), mesh.vertex_count);
      ASSERT_EQ(decoded->faces.size(), mesh.faces.size());
      for (const Face& face : decoded->faces)
        ASSERT_LT(*std::max_element(face.begin(), face.end()), mesh.vertex_count);
      expect_well_formed(decoded->gates);
    }
  }
}

TEST(Connectivity, RandomBytesAreSafe) {
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes(1 + random() % 100);
    const bool constant = i % 4 == 0;
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(constant ? i / 4 : random());
    const auto limit = static_cast<std::uint32_t>(kMaxElementsPerByte * bytes.size());
    const auto vertices = static_cast<std::uint32_t>(random() % limit);
    const auto decoded = decode_connectivity(bytes, vertices, limit - vertices);
    if (decoded) expect_well_formed(decoded->gates);
  }
}

/// Vertex lines and triangle faces of an OBJ file; an empty mesh where there is none.
Mesh read_obj(const std::string& path) {
  Mesh mesh;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") ++mesh.vertex_count;
    if (word != "f") continue;
    Face face{};
    for (std::uint32_t& v : face) {
      words >> word;
      v = static_cast<std::uint32_t>(std::stoul(word)) - 1;
    }
    mesh.faces.push_back(face);
  }
  return mesh;
}

TEST(Connectivity, RealMeshesStayWithinTheirBitsPerVertex) {
  const char* const variable = std::getenv("TVG_DATA_DIR");
  const std::filesystem::path folder = variable != nullptr ? variable : "";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "set TVG_DATA_DIR to the folder of the real sequences";
  for (const auto& [name, bound] :
       {std::pair{"dance", 0.7}, {"crane", 2.4}, {"chicken", 3.0}, {"horse-gallop", 2.3}, {"cow", 2.2}}) {
    const Mesh mesh = read_obj((folder / (std::string(name) + ".obj")).string());
    if (mesh.faces.empty()) GTEST_SKIP() << "no " << name << ".obj in " << folder;
    SCOPED_TRACE(name);
    EXPECT_LT(8.0 * static_cast<double>(encode_connectivity(mesh).bytes.size()), bound * mesh.vertex_count);
    expect_round_trip(mesh);
  }
}

}  // namespace
}  // namespace tvg
