#include "connectivity/coarse_mesh_encode.hpp"
#include "connectivity/mesh_coder_encode.hpp"
#include "connectivity/vertex_levels.hpp"
#include "connectivity/vertex_levels_encode.hpp"
#include "tests/codec/levels_toolbox.hpp"
#include "tests/connectivity/mesh_builders.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg::test {
namespace {

TEST(VertexLevels, ComeBackWhateverTheyAre) {
  std::mt19937 random(3);
  for (const NamedMesh& named : all_sorts_of_meshes()) {
    const EncodedMesh mesh = encode_mesh(named.mesh, true);
    for (const std::uint32_t count : {1u, 2u, 5u, 64u}) {
      if (named.mesh.vertex_count < count) continue;
      std::vector<std::uint8_t> levels, back;
      for (std::uint32_t v = 0; v < named.mesh.vertex_count; ++v)
        levels.push_back(static_cast<std::uint8_t>(v < count ? v : random() % count));
      const Fault fault = decode_levels(encode_levels(levels, mesh.coded.gates), mesh.coded.gates, back);
      EXPECT_FALSE(fault) << named.name << ": " << fault.sentence;
      EXPECT_EQ(back, levels) << named.name;
    }
  }
}

TEST(VertexLevels, OfIndependentSetsTakeAboutTwoBits) {
  const Mesh mesh = grid(60, 60);
  const EncodedMesh coded = encode_mesh(mesh, true, greedy_levels(mesh, 6).get());
  EXPECT_LT(coded.levels.size() * 8, std::size_t{mesh.vertex_count} * 5 / 2);
}

/// What a decoder makes of a lod of a mesh.
Result<CodedMesh> decoded(const EncodedMesh& encoded, Bytes lods, std::uint32_t lod) {
  CodedMesh mesh = encoded.coded;
  mesh.levels.clear();
  mesh.info.lods.clear();
  MeshLayout layout{mesh.mesh.vertex_count, static_cast<std::uint32_t>(mesh.mesh.faces.size()), true, {}, {}};
  layout.levels = encoded.levels;
  layout.lods = lods;
  if (Status status = decode_levels_of_mesh(layout, lod, mesh); !status.ok()) return status.error();
  return mesh;
}

TEST(CoarseMeshes, AreDecodedOnlyWhereTheyAreDrawn) {
  const Mesh mesh = grid(12, 12);
  const auto levels = greedy_levels(mesh, 5, {2, 4});
  const EncodedMesh encoded = encode_mesh(mesh, true, levels.get());
  for (std::uint32_t lod = 0; lod < 4; ++lod) {
    const Result<CodedMesh> whole = decoded(encoded, encoded.lods, lod);
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->info.lod, std::min(lod, 2u));
    EXPECT_EQ(whole->parts_wanted(), 3 - std::min(lod, 2u));
    EXPECT_TRUE(std::is_sorted(whole->cut.numbers.begin(), whole->cut.numbers.end()));
  }
  // The last byte is one of the order of the coarsest.
  std::vector<std::uint8_t> damaged = encoded.lods;
  damaged.back() ^= 0x55;
  EXPECT_TRUE(decoded(encoded, damaged, 0));
  EXPECT_TRUE(decoded(encoded, damaged, 1));
  EXPECT_FALSE(decoded(encoded, damaged, 2));
}

TEST(CoarseMeshes, KeepTheirBoundsWhateverTheBytes) {
  const Mesh mesh = grid(9, 9);
  const EncodedMesh encoded = encode_mesh(mesh, true, greedy_levels(mesh, 5, {1, 4}).get());
  std::mt19937 random(9);
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::uint8_t> damaged = encoded.lods;
    for (int changes = 1 + static_cast<int>(random() % 3); changes > 0; --changes)
      damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    damaged.resize(damaged.size() - (random() % 4 == 0 ? random() % damaged.size() : 0));
    const Result<CodedMesh> result = decoded(encoded, damaged, 1 + random() % 2);
    if (!result) continue;
    for (const Face& face : result->cut.mesh.faces) {
      for (const std::uint32_t v : face) ASSERT_LT(v, result->cut.vertices.size());
    }
  }
}

}  // namespace
}  // namespace tvg::test
