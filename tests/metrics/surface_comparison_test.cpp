#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <tvg/metrics.hpp>

namespace tvg {
namespace {

struct Sheet {
  Mesh mesh;
  std::vector<float> positions;
};

/// The square [0, 1]^2 at a height, in so many cells along each side.
Sheet sheet(std::uint32_t cells, float height) {
  Sheet result;
  for (std::uint32_t i = 0; i <= cells; ++i) {
    for (std::uint32_t j = 0; j <= cells; ++j) {
      result.positions.push_back(static_cast<float>(i) / static_cast<float>(cells));
      result.positions.push_back(static_cast<float>(j) / static_cast<float>(cells));
      result.positions.push_back(height);
    }
  }
  const std::uint32_t row = cells + 1;
  result.mesh.vertex_count = row * row;
  for (std::uint32_t i = 0; i < cells; ++i) {
    for (std::uint32_t j = 0; j < cells; ++j) {
      const std::uint32_t a = i * row + j;
      result.mesh.faces.push_back({a, a + row, a + row + 1});
      result.mesh.faces.push_back({a, a + row + 1, a + 1});
    }
  }
  return result;
}

SurfaceReport compare(const Sheet& original, const Sheet& other, const SurfaceSettings& settings = {}) {
  SurfaceComparison comparison(original.mesh, other.mesh, settings);
  EXPECT_TRUE(comparison.add_frame(original.positions, other.positions).ok());
  return comparison.report();
}

TEST(SurfaceComparison, SurfacesThatAreTheSameAreNotApartWhateverTheirMeshes) {
  const SurfaceReport report = compare(sheet(7, 0.25F), sheet(3, 0.25F));
  EXPECT_EQ(report.frames, 1U);
  EXPECT_EQ(report.original_vertices, 64U);
  EXPECT_EQ(report.other_vertices, 16U);
  EXPECT_EQ(report.original_faces, 98U);
  EXPECT_EQ(report.other_faces, 18U);
  EXPECT_LT(report.rms, 1e-7);
  EXPECT_LT(report.hausdorff, 1e-6);
}

TEST(SurfaceComparison, AShiftAcrossTheSurfaceIsTheDistanceInEveryFigure) {
  const SurfaceReport report = compare(sheet(7, 0), sheet(3, 0.5F));
  EXPECT_NEAR(report.diagonal, std::sqrt(2), 1e-12);
  EXPECT_NEAR(report.rms, 0.5, 1e-7);
  EXPECT_NEAR(report.worst_rms, 0.5, 1e-7);
  EXPECT_NEAR(report.hausdorff, 0.5, 1e-7);
  EXPECT_NEAR(report.mean_hausdorff, 0.5, 1e-7);
  EXPECT_NEAR(report.relative_rms, 0.5 / std::sqrt(2), 1e-7);
  EXPECT_NEAR(report.relative_hausdorff, 0.5 / std::sqrt(2), 1e-7);
  ASSERT_EQ(report.measured.size(), 1U);
  EXPECT_NEAR(report.measured[0].rms_to_other, 0.5, 1e-7);
  EXPECT_NEAR(report.measured[0].rms_to_original, 0.5, 1e-7);
}

TEST(SurfaceComparison, WhatIsMissingShowsInOneDirectionAlone) {
  // Half of a sheet: its points all lie on the whole, whose far half is up to 0.5 away. Over x from 0.5 to 1
  // the mean square of x - 0.5 is 1/12, over the whole sheet half of that.
  Sheet half = sheet(4, 0);
  for (std::size_t v = 0; v < half.mesh.vertex_count; ++v) half.positions[3 * v] *= 0.5F;
  const SurfaceReport report = compare(sheet(4, 0), half);
  const SurfaceDistances& frame = report.measured.at(0);
  EXPECT_LT(frame.rms_to_original, 1e-7);
  EXPECT_LT(frame.hausdorff_to_original, 1e-7);
  EXPECT_NEAR(frame.rms_to_other, std::sqrt(1.0 / 24), 1e-3);
  EXPECT_NEAR(frame.hausdorff_to_other, 0.5, 1e-7);
  EXPECT_EQ(frame.rms(), frame.rms_to_other);
  EXPECT_EQ(report.rms, frame.rms_to_other);
}

TEST(SurfaceComparison, FacesCountByTheirArea) {
  // A large triangle at distance 1 and one of a hundredth of its area at distance 10: mean square
  // (100 * 1 + 1 * 100) / 101.
  const Mesh two{6, {{0, 1, 2}, {3, 4, 5}}};
  const std::vector<float> original = {0, 0, 0, 100, 0, 0, 0, 100, 0, 1000, 0, 0, 1010, 0, 0, 1000, 10, 0};
  std::vector<float> other = original;
  for (std::size_t v = 0; v < 6; ++v) other[3 * v + 2] = v < 3 ? 1 : 10;
  SurfaceComparison comparison(two, two, {100000, 1});
  ASSERT_TRUE(comparison.add_frame(original, other).ok());
  EXPECT_NEAR(comparison.report().rms, std::sqrt(200.0 / 101), 1e-3);
}

TEST(SurfaceComparison, FramesAreSummedUpAndTheWorstIsNamed) {
  const Sheet low = sheet(2, 0);
  SurfaceComparison comparison(low.mesh, sheet(5, 0).mesh);
  for (const float height : {0.0F, 3.0F, 0.0F, 4.0F}) {
    ASSERT_TRUE(comparison.add_frame(low.positions, sheet(5, height).positions).ok());
  }
  const SurfaceReport report = comparison.report();
  EXPECT_NEAR(report.rms, 2.5, 1e-6);  // sqrt((9 + 16) / 4)
  EXPECT_NEAR(report.mean_hausdorff, 7.0 / 4, 1e-6);
  EXPECT_NEAR(report.hausdorff, 4, 1e-6);
  EXPECT_EQ(report.worst_rms_frame, 3U);
  EXPECT_EQ(report.worst_hausdorff_frame, 3U);
}

TEST(SurfaceComparison, AStrideLeavesFramesOutOfAllButTheDiagonal) {
  const Sheet low = sheet(2, 0);
  SurfaceComparison comparison(low.mesh, low.mesh, {100, 2});
  for (const float height : {0.0F, 5.0F, 0.0F}) {
    EXPECT_EQ(comparison.measures_next(), height == 0.0F);
    ASSERT_TRUE(comparison.add_frame(sheet(2, height).positions, low.positions).ok());
  }
  const SurfaceReport report = comparison.report();
  EXPECT_EQ(report.frames, 3U);
  ASSERT_EQ(report.measured.size(), 2U);
  EXPECT_EQ(report.measured[1].frame, 2U);
  EXPECT_EQ(report.hausdorff, 0);
  EXPECT_NEAR(report.diagonal, std::sqrt(27), 1e-9);
}

TEST(SurfaceComparison, FiguresAreTheSameInEveryRun) {
  const Sheet fine = sheet(9, 0);
  Sheet coarse = sheet(4, 0);
  for (std::size_t i = 2; i < coarse.positions.size(); i += 3) {
    coarse.positions[i] = std::sin(static_cast<float>(i));
  }
  const SurfaceReport first = compare(fine, coarse), second = compare(fine, coarse);
  EXPECT_EQ(first.rms, second.rms);
  EXPECT_EQ(first.hausdorff, second.hausdorff);
  EXPECT_GT(first.rms, 0);
}

TEST(SurfaceComparison, SurfacesWithoutAreaAreComparedByTheirPoints) {
  const Mesh line{3, {{0, 1, 2}}};
  const std::vector<float> here = {0, 0, 0, 1, 0, 0, 2, 0, 0}, there = {0, 3, 0, 1, 3, 0, 2, 3, 0};
  SurfaceComparison comparison(line, line);
  ASSERT_TRUE(comparison.add_frame(here, there).ok());
  EXPECT_NEAR(comparison.report().rms, 3, 1e-9);
}

TEST(SurfaceComparison, RefusesWhatHasNoSurface) {
  const Sheet good = sheet(2, 0);
  const auto code = [&good](const Mesh& other, const std::vector<float>& positions,
                            const SurfaceSettings& settings = {}) {
    SurfaceComparison comparison(good.mesh, other, settings);
    const Status status = comparison.add_frame(good.positions, positions);
    EXPECT_FALSE(status.ok());
    EXPECT_EQ(comparison.report().frames, 0U);
    return status.error().code;
  };
  const Mesh triangle{3, {{0, 1, 2}}};
  EXPECT_EQ(code({3, {}}, std::vector<float>(9)), ErrorCode::kInvalidInput);
  EXPECT_EQ(code({3, {{0, 1, 3}}}, std::vector<float>(9)), ErrorCode::kInvalidInput);
  EXPECT_EQ(code(triangle, std::vector<float>(8)), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(triangle, std::vector<float>(9, NAN)), ErrorCode::kInvalidInput);
  EXPECT_EQ(code(triangle, std::vector<float>(9), {0, 1}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(triangle, std::vector<float>(9), {10, 0}), ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace tvg
