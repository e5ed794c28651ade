#include "player/view/draft_faces.hpp"

#include "corpus/corpus.hpp"

#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace tvg::player {
namespace {

TEST(DraftFaces, AreFewAndStayWithinTheVertices) {
  for (const char* name : {"hand", "cloth", "soup"}) {
    const Mesh mesh = corpus::find_corpus_entry(name)->make({5000, 1}).sequence.mesh;
    const std::vector<Face> faces = draft_faces(mesh);
    EXPECT_LT(faces.size(), mesh.faces.size() / 2) << name;
    EXPECT_GT(faces.size(), mesh.faces.size() / 10) << name;
    for (const Face& face : faces) {
      for (const std::uint32_t corner : face) EXPECT_LT(corner, mesh.vertex_count);
    }
  }
}

TEST(DraftFaces, OfAClosedMeshHaveNoBoundary) {
  const Mesh mesh = corpus::find_corpus_entry("hand")->make({5000, 1}).sequence.mesh;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;  // of the two directions of each edge
  for (const Face& face : draft_faces(mesh)) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = face[i];
      const std::uint32_t to = face[(i + 1) % 3];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0);
}

TEST(DraftFaces, OfNothingAreNothing) {
  EXPECT_TRUE(draft_faces({}).empty());
  EXPECT_TRUE(draft_faces({3, {}}).empty());
}

}  // namespace
}  // namespace tvg::player
