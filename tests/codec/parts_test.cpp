#include "attributes/parts.hpp"

#include "attributes/parts_encode.hpp"
#include "attributes/polygons.hpp"
#include "attributes/polygons_encode.hpp"
#include "connectivity/connectivity_encode.hpp"
#include "tests/codec/properties_toolbox.hpp"

namespace tvg::test {
namespace {

using Section = std::vector<std::uint8_t>;

/// A mesh as the coders of properties see it, and what it has.
struct Coded {
  explicit Coded(Mesh given) : mesh(std::move(given)), encoded(encode_connectivity(mesh)) {}

  PropertyMesh view() const { return {encoded.connectivity.faces, encoded.order, nullptr}; }
  Section parts() const { return encode_parts(properties, view(), encoded.first_corners); }
  Section polygons() const {
    return encode_polygons(properties.polygons, mesh.faces, view(), encoded.first_corners).section;
  }
  /// Parts by face of the mesh, from parts by face of the traversal.
  std::vector<std::uint32_t> in_order_of_mesh(const std::vector<std::uint32_t>& parts) const {
    std::vector<std::uint32_t> result(parts.size());
    for (std::size_t f = 0; f < parts.size(); ++f) result[encoded.first_corners[f] / 3] = parts[f];
    return result;
  }

  Mesh mesh;
  EncodedConnectivity encoded;
  MeshProperties properties;
};

Result<MeshProperties> read_parts(const Coded& coded, const Section& section,
                                  std::uint64_t bound = std::uint64_t{1} << 30) {
  MeshProperties properties;
  PropertyBudget budget(bound);
  const Status status = decode_parts(section, coded.view(), budget, properties);
  if (!status.ok()) return status.error();
  return properties;
}

void expect_back(const Coded& coded) {
  const Result<MeshProperties> back = read_parts(coded, coded.parts());
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(back->parts, coded.properties.parts);
  EXPECT_EQ(coded.in_order_of_mesh(back->face_parts), coded.properties.face_parts);
}

/// A sheet whose left half is of one part and whose right half is of another.
Coded two_halves() {
  Coded coded(grid(40, 40));
  coded.properties.parts = {{"sheet", "left", "red"}, {"sheet", "right", "blue"}};
  for (std::size_t f = 0; f < coded.mesh.faces.size(); ++f)
    coded.properties.face_parts.push_back(f / 2 % 40 < 20 ? 0 : 1);
  return coded;
}

TEST(Parts, ComeBackOnAnySortOfMesh) {
  std::mt19937 random(1);
  for (const auto& [name, mesh] : all_sorts_of_meshes()) {
    SCOPED_TRACE(name);
    if (mesh.vertex_count == 0) continue;
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{300}}) {
      Coded coded(mesh);
      for (std::size_t i = 0; i < count; ++i)
        coded.properties.parts.push_back({"o" + std::to_string(i / 4), "", "m" + std::to_string(i % 3)});
      for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        coded.properties.face_parts.push_back(static_cast<std::uint32_t>(random() % count));
      expect_back(coded);
    }
  }
}

TEST(Parts, HaveNamesOfAllSorts) {
  Coded coded(grid(3, 3));
  coded.properties.parts = {{"", "", ""},         {"Cube", "Cube", "Cube"}, {"Cube", "", "Cube.001"},
                            {"Cube", "a", ""},    {"Cub", "Cube.001", "a"}, {"Cube", "a", ""},
                            {"\xC3\xA4", "", ""}, {"\xC3\xB6", "", ""}};
  for (std::uint32_t f = 0; f < coded.mesh.faces.size(); ++f)
    coded.properties.face_parts.push_back(7 - f % 8);
  expect_back(coded);
}

TEST(Parts, CostLittleButWhereTheyMeet) {
  const Coded coded = two_halves();
  const std::size_t names = 1 + 3 + 5 + 3 + 4 + 3 + 3 + 1 + 3 + 5 + 3 + 4;
  expect_back(coded);
  EXPECT_LT(coded.parts().size(), names + 20) << "40 rows";
}

TEST(Parts, OfManyObjectsAreFoundInTheirOrder) {
  Mesh mesh;
  for (int i = 0; i < 200; ++i) mesh = joined(mesh, tetrahedron());
  Coded coded(mesh);
  for (std::uint32_t i = 0; i < 200; ++i) coded.properties.parts.push_back({std::to_string(i), "", ""});
  for (std::uint32_t f = 0; f < 800; ++f) coded.properties.face_parts.push_back(f / 4);
  expect_back(coded);
  Coded without = coded;
  std::fill(without.properties.face_parts.begin(), without.properties.face_parts.end(), 0u);
  EXPECT_LT(coded.parts().size(), without.parts().size() + 60) << "2 bits an object";
}

TEST(Parts, TakeNoMoreThanTheHeadDeclares) {
  const Coded coded = two_halves();
  const std::uint64_t bound =
      property_bytes(coded.properties, coded.mesh.vertex_count, coded.mesh.faces.size());
  EXPECT_TRUE(read_parts(coded, coded.parts(), bound));
  const Result<MeshProperties> refused = read_parts(coded, coded.parts(), bound - 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimitExceeded);
}

TEST(Parts, OfFewBytesDoNotGrowBeyondTheBound) {
  const Coded coded(grid(2, 2));
  Section section = {0xE8, 0x07};                     // 1000 parts
  section.insert(section.end(), {1, 0, 0x80, 0x08});  // a name of 1024 bytes
  section.insert(section.end(), 1024, 'a');
  for (int i = 0; i < 2 + 999 * 3; ++i) section.push_back(2);  // that all have
  const Result<MeshProperties> refused = read_parts(coded, section, 1u << 20);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimitExceeded);
}

void expect_sane(const Coded& coded, const Section& section) {
  const Result<MeshProperties> read = read_parts(coded, section);
  if (!read) return;
  ASSERT_EQ(read->face_parts.size(), coded.mesh.faces.size());
  for (const std::uint32_t part : read->face_parts) ASSERT_LT(part, read->parts.size());
  for (const Part& part : read->parts) {
    ASSERT_TRUE(is_metadata_text(part.object) && is_metadata_text(part.group) &&
                is_metadata_text(part.material));
  }
}

TEST(Parts, ThatAreCutOrDamagedAreRefusedOrSane) {
  const Coded coded = two_halves();
  const Section good = coded.parts();
  for (std::size_t length = 0; length < good.size(); ++length) {
    const Section cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_FALSE(read_parts(coded, cut)) << length;
  }
  Section longer = good;
  longer.push_back(0);
  EXPECT_FALSE(read_parts(coded, longer));
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int change = 1; change < 256; ++change) {
      Section damaged = good;
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ change);
      expect_sane(coded, damaged);
    }
  }
}

TEST(Parts, OneAloneHasNothingBehindItsNames) {
  Coded coded(grid(3, 3));
  coded.properties.parts = {{"a", "b", "c"}};
  coded.properties.face_parts.assign(coded.mesh.faces.size(), 0);
  Section section = coded.parts();
  EXPECT_EQ(section.size(), 1u + 4 + 4 + 4);
  EXPECT_TRUE(read_parts(coded, section));
  section.push_back(0);
  EXPECT_FALSE(read_parts(coded, section));
}

/// Whether a section is refused, or says what can be.
void expect_sane_polygons(const Coded& coded, const Section& section, bool refused = false) {
  PropertyBudget budget(1u << 20);
  Result<FaceFans> fans = decode_polygons(section, coded.view(), budget);
  EXPECT_FALSE(refused && fans);
  if (!fans) return;
  std::vector<Face> faces = coded.encoded.connectivity.faces;
  MeshProperties properties;
  ASSERT_TRUE(take_fans(std::move(*fans), faces, properties).ok());
  ASSERT_EQ(sorted_faces(faces), sorted_faces(coded.encoded.connectivity.faces));
  std::size_t end = 0;
  for (const Polygon& polygon : properties.polygons) {
    ASSERT_GE(polygon.first_triangle, end);
    ASSERT_GE(polygon.corners, 4u);
    end = polygon.first_triangle + polygon.corners - 2;
    ASSERT_LE(end, faces.size());
    for (std::size_t f = polygon.first_triangle + 1; f < end; ++f) {
      ASSERT_EQ(faces[f][0], faces[f - 1][0]);
      ASSERT_EQ(faces[f][1], faces[f - 1][2]);
    }
  }
}

TEST(Polygons, ThatAreCutOrDamagedAreRefusedOrSane) {
  std::mt19937 random(2);
  Coded coded(grid(12, 10));
  for (std::size_t f = 0; f < coded.mesh.faces.size(); f += 2) {
    Face &first = coded.mesh.faces[f], &second = coded.mesh.faces[f + 1];
    while (std::count(second.begin(), second.end(), first[0]) == 0 ||
           std::count(second.begin(), second.end(), first[2]) == 0)
      std::rotate(first.begin(), first.begin() + 1, first.end());
    while (second[0] != first[0]) std::rotate(second.begin(), second.begin() + 1, second.end());
    if (random() % 3 != 0) coded.properties.polygons.push_back({f, 4});
  }
  coded = [&] {
    Coded again(coded.mesh);
    again.properties = coded.properties;
    return again;
  }();
  const Section good = coded.polygons();
  ASSERT_GT(good.size(), 10u);
  expect_sane_polygons(coded, good);
  for (std::size_t length = 0; length < good.size(); ++length)
    expect_sane_polygons(coded, {good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)}, true);
  Section longer = good;
  longer.push_back(0);
  expect_sane_polygons(coded, longer, true);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int change = 1; change < 256; ++change) {
      Section damaged = good;
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ change);
      expect_sane_polygons(coded, damaged);
    }
  }
  for (int round = 0; round < 2000; ++round) {
    Section noise(1 + random() % 60);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    expect_sane_polygons(coded, noise);
  }
}

}  // namespace
}  // namespace tvg::test
