#include "encoder/importers/open_source.hpp"
#include "measure/curvature_norm.hpp"
#include "measure_toolbox.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <numeric>

namespace tvg {
namespace {

/// Ranks from 0; equal values share the mean of theirs.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t k = begin; k < end; ++k) {
      result[order[k]] = static_cast<double>(begin + end - 1) / 2;
    }
    begin = end;
  }
  return result;
}

/// Spearman's: the correlation of the ranks.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks(a), y = ranks(b);
  const double mean = static_cast<double>(x.size() - 1) / 2;
  double xy = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xy / std::sqrt(xx * yy);
}

/// The mean length of the edges at each vertex in the first frame.
std::vector<double> edge_lengths(const Sequence& sequence) {
  std::vector<double> sum(sequence.mesh.vertex_count, 0.0), count(sum);
  const FramePositions& at = sequence.frames[0];
  for (const Face& face : sequence.mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = face[k], b = face[(k + 1) % 3];
      const double length =
          std::hypot(at[3 * a] - at[3 * b], at[3 * a + 1] - at[3 * b + 1], at[3 * a + 2] - at[3 * b + 2]);
      for (const std::size_t v : {a, b}) sum[v] += length, ++count[v];
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= std::max(1.0, count[v]);
  return sum;
}

TEST(RankCorrelation, IsOneForTheSameOrderAndMinusOneForTheOpposite) {
  EXPECT_NEAR(rank_correlation({1, 5, 2, 9}, {10, 30, 20, 1000}), 1, 1e-12);
  EXPECT_NEAR(rank_correlation({1, 5, 2, 9}, {4, 2, 3, 1}), -1, 1e-12);
  EXPECT_NEAR(rank_correlation({1, 1, 2, 2}, {1, 2, 1, 2}), 0, 1e-12);
}

struct Expected {
  const char* name;
  double least;          ///< correlation of the criteria as they are, less a margin of 0.05
  double least_of_bend;  ///< the same of the norm times the length of edges, which lie at the vertex
};

class RealData : public testing::TestWithParam<Expected> {};

TEST_P(RealData, BothCurvaturesRankVerticesAlike) {
  const char* const variable = std::getenv("TVG_DATA_DIR");
  const std::filesystem::path folder = variable != nullptr ? variable : "";
  const std::string stem = (folder / GetParam().name).string();
  if (!std::filesystem::exists(stem + ".pc2")) {
    GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  }
  const auto source = cli::open_source({{stem + ".obj", stem + ".pc2"}, FrameRange{0, 24}}).source;
  Sequence sequence{source->mesh(), {}, {}};
  FramePositions frame(3 * std::size_t{sequence.mesh.vertex_count});
  while (*source->read_frame(frame)) sequence.frames.push_back(frame);
  ASSERT_EQ(sequence.frames.size(), 25U);
  const std::vector<double> curv = test::evaluate("curv", sequence.mesh, sequence.frames);
  std::vector<double> norm = test::evaluate("curvature-norm", sequence.mesh, sequence.frames);
  const double correlation = rank_correlation(curv, norm);
  EXPECT_GT(correlation, GetParam().least);
  // Eq. 1 sees how far the faces of a ring turn, so it grows with their size, and the norm does not.
  const std::vector<double> lengths = edge_lengths(sequence);
  for (std::size_t v = 0; v < norm.size(); ++v) norm[v] *= lengths[v];
  const double of_bend = rank_correlation(curv, norm);
  EXPECT_GT(of_bend, GetParam().least_of_bend);
  std::printf("%s: rank correlation of curv and curvature-norm %.3f, times edge length %.3f\n",
              GetParam().name, correlation, of_bend);
}

INSTANTIATE_TEST_SUITE_P(, RealData,
                         testing::Values(Expected{"chicken", 0.64, 0.75}, Expected{"dance", 0.62, 0.84},
                                         Expected{"crane", 0.85, 0.82}),
                         [](const auto& named) { return std::string(named.param.name); });

}  // namespace
}  // namespace tvg
