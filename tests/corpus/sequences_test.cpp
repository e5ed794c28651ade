#include "corpus/corpus.hpp"
#include "tests/corpus/mesh_facts.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace tvg::corpus {
namespace {

using namespace tvg::testing;

double distance(const std::vector<float>& frame, std::size_t a, std::size_t b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double difference = static_cast<double>(frame[3 * a + k]) - frame[3 * b + k];
    sum += difference * difference;
  }
  return std::sqrt(sum);
}

/// The number of vertices whose position is not the same in every frame.
std::size_t moving_vertices(const Sequence& sequence) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < sequence.mesh.vertex_count; ++v) {
    const bool moves =
        std::any_of(sequence.frames.begin(), sequence.frames.end(), [&](const FramePositions& frame) {
          return !std::equal(frame.begin() + static_cast<std::ptrdiff_t>(3 * v),
                             frame.begin() + static_cast<std::ptrdiff_t>(3 * v + 3),
                             sequence.frames[0].begin() + static_cast<std::ptrdiff_t>(3 * v));
        });
    if (moves) ++count;
  }
  return count;
}

TEST(Corpus, EverySequenceIsWellFormedAndFinite) {
  for (const CorpusEntry& entry : corpus_entries()) {
    for (const SequenceSize& size : {SequenceSize{100, 1}, SequenceSize{400, 12}, SequenceSize{2500, 5}}) {
      const Sequence sequence = entry.make(size).sequence;
      ASSERT_EQ(sequence.frames.size(), size.frames) << entry.name;
      ASSERT_FALSE(sequence.mesh.faces.empty()) << entry.name;
      for (const Face& face : sequence.mesh.faces) {
        for (const std::uint32_t v : face) ASSERT_LT(v, sequence.mesh.vertex_count) << entry.name;
      }
      for (const FramePositions& frame : sequence.frames) {
        ASSERT_EQ(frame.size(), std::size_t{3} * sequence.mesh.vertex_count) << entry.name;
        for (const float value : frame) ASSERT_TRUE(std::isfinite(value)) << entry.name;
      }
      EXPECT_EQ(sequence.metadata.at("name"), entry.name);
      EXPECT_EQ(sequence.metadata.at("fps"), "30");
    }
  }
}

TEST(Corpus, SizesComeNearWhatIsAsked) {
  for (const CorpusEntry& entry : corpus_entries()) {
    // The hand has steps of four, and a small toy nearly so: they may be off by two.
    const double tolerance = entry.name == "hand" || entry.name == "toy" ? 2.05 : 1.2;
    for (const std::uint32_t wanted : {1500U, 100000U}) {
      const double got = entry.make({wanted, 1}).sequence.mesh.vertex_count;
      EXPECT_LT(got, wanted * tolerance) << entry.name;
      EXPECT_GT(got * tolerance, wanted) << entry.name;
    }
  }
}

TEST(Corpus, MoreFramesGoOnWithTheSameMotion) {
  for (const CorpusEntry& entry : corpus_entries()) {
    const Sequence few = entry.make({400, 4}).sequence;
    const Sequence more = entry.make({400, 9}).sequence;
    EXPECT_EQ(few.mesh, more.mesh) << entry.name;
    EXPECT_TRUE(std::equal(few.frames.begin(), few.frames.end(), more.frames.begin())) << entry.name;
    EXPECT_NE(more.frames[4], more.frames[8]) << entry.name;
  }
}

TEST(Corpus, MotionIsSmoothFromFrameToFrame) {
  for (const CorpusEntry& entry : corpus_entries()) {
    const Sequence sequence = entry.make({1000, 90}).sequence;
    const auto [low, high] = std::minmax_element(sequence.frames[0].begin(), sequence.frames[0].end());
    const float extent = *high - *low;
    for (std::size_t f = 1; f < sequence.frames.size(); ++f) {
      for (std::size_t k = 0; k < sequence.frames[f].size(); ++k) {
        ASSERT_LT(std::abs(sequence.frames[f][k] - sequence.frames[f - 1][k]), 0.15F * extent)
            << entry.name << " frame " << f << " vertex " << k / 3;
      }
    }
  }
}

TEST(Hand, IsOneClosedSurfaceOfGenusZero) {
  for (const std::uint32_t vertices : {400U, 1600U}) {
    const Mesh mesh = make_hand({vertices, 1}).sequence.mesh;
    EXPECT_TRUE(is_closed_and_oriented(mesh));
    EXPECT_EQ(component_count(mesh), 1U);
    EXPECT_EQ(non_manifold_vertex_count(mesh), 0U);
    const auto edges = static_cast<long>(edge_use(mesh).size());
    EXPECT_EQ(static_cast<long>(mesh.vertex_count) - edges + static_cast<long>(mesh.faces.size()), 2);
  }
}

TEST(Hand, StepsOfFour) {
  EXPECT_EQ(make_hand({400, 1}).sequence.mesh.vertex_count, 394U);
  EXPECT_EQ(make_hand({1600, 1}).sequence.mesh.vertex_count, 1570U);
  EXPECT_EQ(make_hand({6000, 1}).sequence.mesh.vertex_count, 6274U);
}

TEST(Hand, SkeletonIsATreeWithBonesOfConstantLength) {
  const JointTracks tracks = make_hand({400, 40}).joints;
  const Skeleton& skeleton = tracks.skeleton;
  ASSERT_EQ(skeleton.joint_names.size(), 21U);
  ASSERT_EQ(skeleton.parents.size(), 21U);
  ASSERT_EQ(tracks.frames.size(), 40U);
  EXPECT_EQ(skeleton.parents[0], -1);
  for (std::size_t j = 1; j < skeleton.parents.size(); ++j) {
    ASSERT_GE(skeleton.parents[j], 0);
    ASSERT_LT(skeleton.parents[j], static_cast<std::int32_t>(j));
    const auto parent = static_cast<std::size_t>(skeleton.parents[j]);
    const double length = distance(tracks.frames[0], j, parent);
    EXPECT_GT(length, 0.5) << skeleton.joint_names[j];
    for (const auto& frame : tracks.frames) {
      ASSERT_EQ(frame.size(), 63U);
      EXPECT_NEAR(distance(frame, j, parent), length, 1e-5) << skeleton.joint_names[j];
    }
  }
}

TEST(Hand, FingersBendAtTheirJoints) {
  const JointTracks tracks = make_hand({400, 60}).joints;
  const Skeleton& skeleton = tracks.skeleton;
  const auto index_2 = std::find(skeleton.joint_names.begin(), skeleton.joint_names.end(), "index_2");
  ASSERT_NE(index_2, skeleton.joint_names.end());
  const auto j = static_cast<std::size_t>(index_2 - skeleton.joint_names.begin());
  // A straight joint has its neighbours as far apart as the bones are long together.
  double straightest = 0;
  double most_bent = 1;
  for (const auto& frame : tracks.frames) {
    const double share =
        distance(frame, j - 1, j + 1) / (distance(frame, j - 1, j) + distance(frame, j, j + 1));
    straightest = std::max(straightest, share);
    most_bent = std::min(most_bent, share);
  }
  EXPECT_GT(straightest, 0.99);
  EXPECT_LT(most_bent, 0.85);
}

TEST(Hand, SkinStaysAroundItsJoints) {
  const SkinnedSequence hand = make_hand({1600, 40});
  for (std::size_t f = 0; f < hand.sequence.frames.size(); ++f) {
    for (std::size_t j = 0; j < 21; ++j) {
      double nearest = 1e9;
      for (std::size_t v = 0; v < hand.sequence.mesh.vertex_count; ++v) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const double d =
              static_cast<double>(hand.sequence.frames[f][3 * v + k]) - hand.joints.frames[f][3 * j + k];
          sum += d * d;
        }
        nearest = std::min(nearest, std::sqrt(sum));
      }
      EXPECT_LT(nearest, 2.2) << hand.joints.skeleton.joint_names[j] << " in frame " << f;
    }
  }
}

TEST(Face, IsOneSheetWithSlitsForMouthAndEyes) {
  for (const std::uint32_t vertices : {400U, 2500U}) {
    const Mesh mesh = make_face({vertices, 1}).mesh;
    EXPECT_EQ(component_count(mesh), 1U);
    EXPECT_EQ(boundary_loop_count(mesh), 4U);
    EXPECT_EQ(non_manifold_vertex_count(mesh), 0U);
    for (const auto& [edge, use] : edge_use(mesh)) ASSERT_LE(use, 2);
  }
}

TEST(Face, OnlySmallRegionsMove) {
  const Sequence face = make_face({2500, 60});
  const std::size_t moving = moving_vertices(face);
  EXPECT_GT(moving, face.mesh.vertex_count / 20);
  EXPECT_LT(moving, face.mesh.vertex_count / 2);
}

TEST(Cloth, IsOneSheetThatHardlyStretches) {
  const Sequence cloth = make_cloth({1600, 60});
  EXPECT_EQ(component_count(cloth.mesh), 1U);
  EXPECT_EQ(boundary_loop_count(cloth.mesh), 1U);
  EXPECT_EQ(non_manifold_vertex_count(cloth.mesh), 0U);
  double rest = 0;
  for (const FramePositions& frame : cloth.frames) {
    double sum = 0;
    for (const auto& [edge, use] : edge_use(cloth.mesh)) sum += distance(frame, edge.first, edge.second);
    if (rest == 0) rest = sum;
    EXPECT_NEAR(sum / rest, 1, 0.1);
  }
}

TEST(Cloth, IsHeldAtItsPole) {
  const Sequence cloth = make_cloth({400, 10});
  const std::size_t still = cloth.mesh.vertex_count - moving_vertices(cloth);
  std::size_t at_pole = 0;
  for (std::size_t v = 0; v < cloth.mesh.vertex_count; ++v) {
    if (std::abs(cloth.frames[0][3 * v]) < 1e-6F) ++at_pole;
  }
  EXPECT_EQ(still, at_pole);
  EXPECT_GE(at_pole, 8U);
}

TEST(Toy, EveryComponentIsClosedAndMovesRigidly) {
  const Sequence toy = make_toy({2500, 20});
  ASSERT_EQ(component_count(toy.mesh), kToyPartCount);
  EXPECT_TRUE(is_closed_and_oriented(toy.mesh));
  EXPECT_EQ(non_manifold_vertex_count(toy.mesh), 0U);
  const auto component = component_of_vertex(toy.mesh);
  std::vector<std::uint32_t> first(kToyPartCount, 0);
  for (std::uint32_t v = toy.mesh.vertex_count; v-- > 0;) first[component[v]] = v;
  for (const FramePositions& frame : toy.frames) {
    for (std::uint32_t v = 0; v < toy.mesh.vertex_count; ++v) {
      const std::uint32_t anchor = first[component[v]];
      ASSERT_NEAR(distance(frame, v, anchor), distance(toy.frames[0], v, anchor), 2e-5);
    }
  }
}

TEST(Toy, PartsFaceOutwards) {
  const Sequence toy = make_toy({2500, 1});
  const auto component = component_of_vertex(toy.mesh);
  std::vector<double> volume(kToyPartCount, 0);
  const FramePositions& p = toy.frames[0];
  for (const auto& [a, b, c] : toy.mesh.faces) {
    const auto at = [&](std::uint32_t v, std::size_t k) {
      return static_cast<double>(p[3 * std::size_t{v} + k]);
    };
    volume[component[a]] += at(a, 0) * (at(b, 1) * at(c, 2) - at(b, 2) * at(c, 1)) +
                            at(a, 1) * (at(b, 2) * at(c, 0) - at(b, 0) * at(c, 2)) +
                            at(a, 2) * (at(b, 0) * at(c, 1) - at(b, 1) * at(c, 0));
  }
  for (std::size_t part = 0; part < volume.size(); ++part) EXPECT_GT(volume[part], 0) << part;
}

TEST(Toy, AllPartsButThePlateMove) {
  const Sequence toy = make_toy({2500, 20});
  const auto component = component_of_vertex(toy.mesh);
  std::vector<double> way(kToyPartCount, 0);
  for (std::size_t k = 0; k < toy.frames[0].size(); ++k) {
    way[component[k / 3]] += std::abs(static_cast<double>(toy.frames[19][k]) - toy.frames[0][k]);
  }
  EXPECT_EQ(way[0], 0);
  for (std::size_t part = 1; part < way.size(); ++part) EXPECT_GT(way[part], 1) << part;
}

TEST(Soup, HasEveryDefectPromised) {
  for (const std::uint32_t vertices : {100U, 400U, 2500U}) {
    const SoupSequence soup = make_soup({vertices, 3});
    const Mesh& mesh = soup.sequence.mesh;
    SoupDefects counted;
    std::vector<bool> used(mesh.vertex_count, false);
    std::set<Face> seen;
    for (const Face& face : mesh.faces) {
      for (const std::uint32_t v : face) used[v] = true;
      if (repeats_a_corner(face)) {
        ++counted.repeated_corner_faces;
        continue;
      }
      if (!seen.insert(sorted(face)).second) ++counted.duplicate_faces;
    }
    counted.isolated_vertices = static_cast<std::uint32_t>(std::count(used.begin(), used.end(), false));
    for (const auto& [edge, use] : edge_use(mesh)) counted.non_manifold_edges += use > 2 ? 1 : 0;
    counted.non_manifold_vertices = non_manifold_vertex_count(mesh);

    EXPECT_EQ(counted.isolated_vertices, 7U);
    EXPECT_EQ(counted.repeated_corner_faces, 4U);
    EXPECT_EQ(counted.duplicate_faces, 5U);
    EXPECT_GE(counted.non_manifold_edges, 2U);
    EXPECT_EQ(counted.non_manifold_vertices, 2U);
    EXPECT_EQ(counted.isolated_vertices, soup.defects.isolated_vertices);
    EXPECT_EQ(counted.repeated_corner_faces, soup.defects.repeated_corner_faces);
    EXPECT_EQ(counted.duplicate_faces, soup.defects.duplicate_faces);
    EXPECT_EQ(counted.non_manifold_edges, soup.defects.non_manifold_edges);
    EXPECT_EQ(counted.non_manifold_vertices, soup.defects.non_manifold_vertices);
    EXPECT_GE(boundary_loop_count(mesh), 5U);
  }
}

TEST(Soup, HasFacesWithoutAreaInEveryFrame) {
  const SoupSequence soup = make_soup({400, 30});
  for (const FramePositions& frame : soup.sequence.frames) {
    std::uint32_t without_area = 0;
    for (const Face& face : soup.sequence.mesh.faces) {
      if (repeats_a_corner(face)) continue;
      std::array<std::array<double, 3>, 2> sides{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double origin = frame[3 * std::size_t{face[0]} + k];
        sides[0][k] = frame[3 * std::size_t{face[1]} + k] - origin;
        sides[1][k] = frame[3 * std::size_t{face[2]} + k] - origin;
      }
      double squared_area = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        const double component = sides[0][k] * sides[1][l] - sides[0][l] * sides[1][k];
        squared_area += component * component;
      }
      if (squared_area == 0) ++without_area;
    }
    EXPECT_EQ(without_area, soup.defects.zero_area_faces);
    EXPECT_EQ(without_area, 2U);
  }
}

}  // namespace
}  // namespace tvg::corpus
