#include "tests/codec/properties_toolbox.hpp"

#include <map>
#include <set>

namespace tvg::test {
namespace {

/// Polygons as fans around their first corner.
struct PolygonMesh {
  Mesh mesh;
  std::vector<Polygon> polygons;

  void add(const std::vector<std::uint32_t>& corners) {
    for (const std::uint32_t v : corners) mesh.vertex_count = std::max(mesh.vertex_count, v + 1);
    if (corners.size() > 3)
      polygons.push_back({mesh.faces.size(), static_cast<std::uint32_t>(corners.size())});
    for (std::size_t i = 2; i < corners.size(); ++i)
      mesh.faces.push_back({corners[0], corners[i - 1], corners[i]});
  }
};

/// Quads of which each begins at its lower left corner, or anywhere.
PolygonMesh quads(std::uint32_t columns, std::uint32_t rows, std::mt19937* turns = nullptr) {
  PolygonMesh result;
  for (std::uint32_t y = 0; y + 1 < rows; ++y) {
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t v = y * columns + x;
      std::vector<std::uint32_t> quad = {v, v + 1, v + columns + 1, v + columns};
      if (turns != nullptr) std::rotate(quad.begin(), quad.begin() + (*turns)() % 4, quad.end());
      result.add(quad);
    }
  }
  return result;
}

/// A prism with caps of many corners, and a triangle at every fifth side.
PolygonMesh prism(std::uint32_t corners) {
  PolygonMesh result;
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < corners; ++i) {
    top.push_back(corners + i);
    bottom.insert(bottom.begin(), i);
    const std::uint32_t next = (i + 1) % corners;
    if (i % 5 == 0) {
      result.add({i, next, corners + next});
      result.add({i, corners + next, corners + i});
    } else {
      result.add({next, corners + next, corners + i, i});
    }
  }
  result.add(bottom);
  result.add(top);
  return result;
}

/// The corners of all polygons, from their first one, and of faces that are none, from their least.
std::multiset<std::vector<std::uint32_t>> faces_of(const Mesh& mesh, const std::vector<Polygon>& polygons) {
  std::multiset<std::vector<std::uint32_t>> faces;
  std::size_t done = 0;
  const auto add_triangles = [&](std::size_t end) {
    for (; done < end; ++done) {
      const Face face = sorted_faces({mesh.faces[done]}).front();
      faces.insert({face.begin(), face.end()});
    }
  };
  for (const Polygon& polygon : polygons) {
    add_triangles(polygon.first_triangle);
    std::vector<std::uint32_t> corners = {mesh.faces[done][0], mesh.faces[done][1]};
    for (; done < polygon.first_triangle + polygon.corners - 2; ++done) {
      EXPECT_EQ(mesh.faces[done][0], corners.front());
      EXPECT_EQ(mesh.faces[done][1], corners.back());
      corners.push_back(mesh.faces[done][2]);
    }
    faces.insert(std::move(corners));
  }
  add_triangles(mesh.faces.size());
  return faces;
}

struct Encoded {
  Stream stream;
  EncodeReport report;
};

Encoded encode_with(const Mesh& mesh, const MeshProperties& properties, const EncodeOptions& options = {}) {
  std::mt19937 random(8);
  const Sequence sequence = random_sequence(mesh, 2, random);
  PropertySource source(sequence, properties);
  Encoded encoded;
  const auto sink = [&encoded](std::span<const std::uint8_t> bytes) {
    encoded.stream.insert(encoded.stream.end(), bytes.begin(), bytes.end());
    return Status();
  };
  const Result<EncodeReport> report = encode(source, options, sink);
  EXPECT_TRUE(report) << (report ? "" : report.error().describe());
  if (report) encoded.report = *report;
  return encoded;
}

void expect_back(const PolygonMesh& given, const EncodeOptions& options = {}) {
  MeshProperties properties;
  properties.polygons = given.polygons;
  const Encoded encoded = encode_with(given.mesh, properties, options);
  EXPECT_EQ(encoded.report.polygons_left_out, 0u);
  const DecodedProperties decoded = decode_properties_of(encoded.stream);
  ASSERT_TRUE(decoded.complete) << decoded.error.describe();
  EXPECT_EQ(decoded.properties.polygons.size(), given.polygons.size());
  EXPECT_EQ(faces_of(decoded.mesh, decoded.properties.polygons), faces_of(given.mesh, given.polygons));
}

TEST(Polygons, ComeBackFromTheSameFirstCorner) {
  std::mt19937 random(1);
  for (const Mode mode : {Mode::kElp, Mode::kBasis, Mode::kLossless}) {
    EncodeOptions options;
    options.mode = mode;
    expect_back(quads(12, 9), options);
    expect_back(quads(12, 9, &random), options);
    expect_back(prism(17), options);
    expect_back(prism(300), options);
  }
}

TEST(Polygons, ComeBackWhateverTheOrderOfTheFaces) {
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    PolygonMesh given = prism(5 + static_cast<std::uint32_t>(random() % 40));
    PolygonMesh turned;
    std::vector<std::vector<std::uint32_t>> all;
    for (const auto& face : faces_of(given.mesh, given.polygons)) all.push_back(face);
    std::shuffle(all.begin(), all.end(), random);
    for (auto& face : all) {
      std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random() % face.size()),
                  face.end());
      turned.add(face);
    }
    expect_back(turned);
  }
}

TEST(Polygons, OfARegularGridCostNextToNothing) {
  const PolygonMesh given = quads(100, 100);
  MeshProperties properties;
  const std::size_t without = encode_with(given.mesh, properties).stream.size();
  properties.polygons = given.polygons;
  const std::size_t with = encode_with(given.mesh, properties).stream.size();
  EXPECT_LT(8.0 * static_cast<double>(with - without), 0.1 * static_cast<double>(given.polygons.size()));
}

TEST(Polygons, TakeWhatFacesAndCornersHaveAlong) {
  std::mt19937 random(3);
  const PolygonMesh given = prism(23);
  MeshProperties properties;
  properties.polygons = given.polygons;
  properties.parts = {{"side", "", "a"}, {"cap", "", "b"}};
  for (std::size_t f = 0; f < given.mesh.faces.size(); ++f) properties.face_parts.push_back(f < 46 ? 0 : 1);
  properties.attributes = {random_corners(
      attribute_of("uv", AttributeKind::kTexcoord, AttributeDomain::kCorner, 2), given.mesh, 0.3, random)};
  const DecodedProperties decoded = decode_properties_of(encode_with(given.mesh, properties).stream);
  ASSERT_TRUE(decoded.complete) << decoded.error.describe();
  EXPECT_EQ(faces_of(decoded.mesh, decoded.properties.polygons), faces_of(given.mesh, given.polygons));
  EXPECT_EQ(face_records(decoded.mesh, decoded.properties), face_records(given.mesh, properties));
}

TEST(Polygons, ThatAreNoFanOfNeighboursComeBackAsTrianglesAndAreCounted) {
  PolygonMesh given = quads(4, 3);
  given.add({0, 1, 0, 5});  // goes back and forth
  given.add({0, 1, 5, 4});  // a quad that is there before: which diagonals go together is open
  const std::size_t first = given.mesh.faces.size();
  given.mesh.faces.push_back({2, 3, 7});
  given.mesh.faces.push_back({3, 7, 6});  // not around corner 2
  given.polygons.push_back({first, 4});
  MeshProperties properties;
  properties.polygons = given.polygons;
  const Encoded encoded = encode_with(given.mesh, properties);
  const DecodedProperties decoded = decode_properties_of(encoded.stream);
  ASSERT_TRUE(decoded.complete) << decoded.error.describe();
  EXPECT_GE(encoded.report.polygons_left_out, 1u);
  EXPECT_EQ(decoded.properties.polygons.size() + encoded.report.polygons_left_out, given.polygons.size());
  EXPECT_EQ(sorted_faces(decoded.mesh.faces), sorted_faces(given.mesh.faces));
}

TEST(Polygons, OfAnySortOfMeshComeBackOrAreCounted) {
  std::mt19937 random(4);
  for (const auto& [name, mesh] : all_sorts_of_meshes()) {
    SCOPED_TRACE(name);
    if (mesh.vertex_count == 0 || mesh.faces.empty()) continue;
    PolygonMesh given{mesh, {}};
    for (std::size_t f = 0; f + 3 < mesh.faces.size(); f += 3) {
      const Face& face = mesh.faces[f];
      given.mesh.faces[f + 1] = {face[0], face[2], mesh.faces[f + 1][2]};
      given.polygons.push_back({f, 4});
    }
    MeshProperties properties;
    properties.polygons = given.polygons;
    const Encoded encoded = encode_with(given.mesh, properties);
    const DecodedProperties decoded = decode_properties_of(encoded.stream);
    ASSERT_TRUE(decoded.complete) << decoded.error.describe();
    EXPECT_EQ(decoded.properties.polygons.size() + encoded.report.polygons_left_out, given.polygons.size());
    EXPECT_EQ(sorted_faces(decoded.mesh.faces), sorted_faces(given.mesh.faces));
    const auto back = faces_of(decoded.mesh, decoded.properties.polygons);
    const auto all = faces_of(given.mesh, given.polygons);
    for (const auto& polygon : back) {
      if (polygon.size() > 3) {
        EXPECT_EQ(all.count(polygon), back.count(polygon));
      }
    }
  }
}

TEST(Polygons, FollowFramesThatAreTheSameAsWithoutThem) {
  const PolygonMesh given = prism(12);
  MeshProperties properties;
  const Stream without = encode_with(given.mesh, properties).stream;
  properties.polygons = given.polygons;
  const Stream with = encode_with(given.mesh, properties).stream;
  expect_same_frames(decode_stream(with), decode_stream(without));
}

}  // namespace
}  // namespace tvg::test
