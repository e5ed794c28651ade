#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

#include <tvg/metrics.hpp>

namespace tvg {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Mesh kTriangle{3, {{0, 1, 2}}};
const std::vector<float> kRightTriangle = {0, 0, 0, 3, 0, 0, 0, 4, 0};

ComparisonReport compare(const Mesh& mesh, const std::vector<std::vector<float>>& original,
                         const std::vector<std::vector<float>>& decoded,
                         const ComparisonSettings& settings = {}) {
  SequenceComparison comparison(mesh, settings);
  for (std::size_t f = 0; f < original.size(); ++f) {
    const Status status = comparison.add_frame(original[f], decoded[f]);
    EXPECT_TRUE(status.ok()) << status.error().describe();
  }
  return comparison.report();
}

TEST(SequenceComparison, FiguresOfATriangleWorkedByHand) {
  // Vertex 0 rises by 0.5, vertex 1 moves by 0.25 along x: sum of squares 0.3125, of absolute values 0.75.
  const std::vector<float> decoded = {0, 0, 0.5, 3.25, 0, 0, 0, 4, 0};
  const ComparisonReport report = compare(kTriangle, {kRightTriangle}, {decoded});
  EXPECT_EQ(report.frames, 1U);
  EXPECT_EQ(report.vertices, 3U);
  EXPECT_DOUBLE_EQ(report.extent, 4);
  EXPECT_DOUBLE_EQ(report.diagonal, 5);
  EXPECT_DOUBLE_EQ(report.max_coordinate_error, 0.5);
  EXPECT_DOUBLE_EQ(report.max_vertex_distance, 0.5);
  EXPECT_DOUBLE_EQ(report.rms_vertex_distance, std::sqrt(0.3125 / 3));
  EXPECT_DOUBLE_EQ(report.rms_coordinate_error, std::sqrt(0.3125 / 9));
  EXPECT_DOUBLE_EQ(report.mean_coordinate_error, 0.75 / 9);
  EXPECT_DOUBLE_EQ(report.relative_max_coordinate_error, 0.1);
  EXPECT_DOUBLE_EQ(report.relative_max_vertex_distance, 0.1);
  EXPECT_DOUBLE_EQ(report.relative_rms_coordinate_error, std::sqrt(0.3125 / 9) / 5);
  EXPECT_DOUBLE_EQ(report.relative_rms_vertex_distance, std::sqrt(0.3125 / 3) / 5);
  EXPECT_NEAR(report.snr_db, 33.6248, 1e-4);  // 4 / (0.75 / 9) = 48
  // Centroid (1, 4/3, 0): squared distances 25/9, 52/9 and 73/9, together 50/3.
  EXPECT_NEAR(report.kg_percent, 100 * std::sqrt(0.3125 / (50.0 / 3)), 1e-12);
  EXPECT_DOUBLE_EQ(report.max_quadric_error, 0.25);
  EXPECT_DOUBLE_EQ(report.mean_quadric_error, 0.25 / 3);
  EXPECT_EQ(report.worst_frame, 0U);
  EXPECT_EQ(report.worst_vertex, 0U);
}

TEST(SequenceComparison, VertexDistanceAndCoordinateErrorAreDifferentThings) {
  const std::vector<float> decoded = {0, 0, 0, 5, 1, -2, 0, 4, 0};
  const ComparisonReport report = compare(kTriangle, {kRightTriangle}, {decoded});
  EXPECT_DOUBLE_EQ(report.max_coordinate_error, 2);
  EXPECT_DOUBLE_EQ(report.max_vertex_distance, 3);
  EXPECT_EQ(report.worst_vertex, 1U);
  EXPECT_DOUBLE_EQ(report.max_quadric_error, 4);
}

TEST(SequenceComparison, SumsAndBoxRunOverAllFrames) {
  const std::vector<float> moved = {10, 0, 0, 13, 0, 0, 10, 4, 0};
  const std::vector<float> moved_decoded = {10, 0, 0, 13, 0, 0, 10, 4, 2};
  const ComparisonReport report =
      compare(kTriangle, {kRightTriangle, moved}, {kRightTriangle, moved_decoded});
  EXPECT_EQ(report.frames, 2U);
  EXPECT_DOUBLE_EQ(report.extent, 13);
  EXPECT_DOUBLE_EQ(report.diagonal, std::sqrt(13.0 * 13 + 16));
  EXPECT_DOUBLE_EQ(report.rms_vertex_distance, std::sqrt(4.0 / 6));
  EXPECT_EQ(report.worst_frame, 1U);
  EXPECT_EQ(report.worst_vertex, 2U);
  // The centroid is each frame's own: moving the triangle does not make its spread of 50/3 any larger.
  EXPECT_NEAR(report.kg_percent, 100 * std::sqrt(4 / (2 * 50.0 / 3)), 1e-12);
}

TEST(SequenceComparison, IdenticalSequencesHaveNoErrorAndInfiniteSnr) {
  const ComparisonReport report = compare(kTriangle, {kRightTriangle}, {kRightTriangle}, {true, 1});
  EXPECT_EQ(report.max_coordinate_error, 0);
  EXPECT_EQ(report.max_vertex_distance, 0);
  EXPECT_EQ(report.rms_coordinate_error, 0);
  EXPECT_EQ(report.relative_rms_vertex_distance, 0);
  EXPECT_EQ(report.kg_percent, 0);
  EXPECT_EQ(report.max_quadric_error, 0);
  EXPECT_EQ(report.snr_db, kInfinity);
  ASSERT_TRUE(report.hausdorff.has_value());
  EXPECT_EQ(*report.hausdorff, 0);
}

TEST(SequenceComparison, QuadricErrorAddsSquaredDistancesToTheFacesAroundTheVertex) {
  // A box's corner: the faces at vertex 0 lie in the three coordinate planes.
  const Mesh corner{4, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}};
  const std::vector<float> original = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::vector<float> decoded = original;
  decoded[0] = 1;
  decoded[1] = 2;
  decoded[2] = 3;
  const ComparisonReport report = compare(corner, {original}, {decoded});
  EXPECT_DOUBLE_EQ(report.max_quadric_error, 1 + 4 + 9);
  EXPECT_DOUBLE_EQ(report.mean_quadric_error, 14.0 / 4);
}

TEST(SequenceComparison, FacesWithoutAreaAddNothingToTheQuadricError) {
  const Mesh mesh{3, {{0, 0, 1}, {0, 1, 2}}};
  const std::vector<float> line = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  const std::vector<float> decoded = {0, 5, 0, 1, 0, 5, 2, 0, 0};
  const ComparisonReport report = compare(mesh, {line}, {decoded});
  EXPECT_EQ(report.max_quadric_error, 0);
  EXPECT_DOUBLE_EQ(report.max_vertex_distance, 5);
}

/// Random positions in a box whose longest side is exactly 8, and the same rounded to a lattice of `bits`.
struct Quantized {
  std::vector<float> original, decoded;
  double mean_lattice_error = 0;
};

Quantized quantize(int bits) {
  Quantized result;
  std::mt19937 random(5);
  const double step = 8 / std::exp2(bits);
  double sum = 0;
  for (int k = 0; k < 3000; ++k) {
    double x = static_cast<double>(random()) / 4294967296.0 * (k % 3 == 0 ? 8 : 5);
    if (k == 0) x = 0;
    if (k == 3) x = 8;
    const auto value = static_cast<float>(x);
    const double index = std::min(std::floor(value / step), std::exp2(bits) - 1);
    result.original.push_back(value);
    result.decoded.push_back(static_cast<float>((index + 0.5) * step));
    sum += std::abs(static_cast<double>(result.decoded.back()) - value) / step;
  }
  result.mean_lattice_error = sum / 3000;
  return result;
}

TEST(SequenceComparison, SnrIsThePapersWhateverTheBits) {
  const Mesh points{1000, {}};
  for (const int bits : {7, 9, 11, 13}) {
    const Quantized q = quantize(bits);
    const ComparisonReport report = compare(points, {q.original}, {q.decoded});
    EXPECT_NEAR(report.snr_db, 20 * std::log10(std::exp2(bits) / q.mean_lattice_error), 1e-9) << bits;
  }
}

TEST(SequenceComparison, TwoBitsMoreAreTwelveDecibels) {
  const Mesh points{1000, {}};
  const Quantized coarse = quantize(9);
  const Quantized fine = quantize(11);
  const double gain = compare(points, {fine.original}, {fine.decoded}).snr_db -
                      compare(points, {coarse.original}, {coarse.decoded}).snr_db;
  EXPECT_NEAR(gain, 12.04, 0.3);
}

TEST(SequenceComparison, KgErrorDoesNotDependOnScaleOrPlace) {
  const Quantized q = quantize(8);
  const Mesh points{1000, {}};
  const double before = compare(points, {q.original}, {q.decoded}).kg_percent;
  Quantized moved = q;
  for (std::vector<float>* values : {&moved.original, &moved.decoded}) {
    for (float& value : *values) value = value * 4 + 64;
  }
  EXPECT_NEAR(compare(points, {moved.original}, {moved.decoded}).kg_percent, before, before * 1e-3);
}

TEST(SequenceComparison, SequencesWithoutExtentGiveInfiniteRatios) {
  const Mesh points{2, {}};
  const std::vector<float> origin(6, 0.0F);
  const std::vector<float> off = {1, 0, 0, 0, 0, 0};
  const ComparisonReport report = compare(points, {origin}, {off});
  EXPECT_EQ(report.kg_percent, kInfinity);
  EXPECT_EQ(report.relative_max_vertex_distance, kInfinity);
  EXPECT_EQ(report.snr_db, -kInfinity);
  const ComparisonReport same = compare(points, {origin}, {origin});
  EXPECT_EQ(same.kg_percent, 0);
  EXPECT_EQ(same.snr_db, kInfinity);
}

TEST(SequenceComparison, NothingComparedIsNoError) {
  for (const Mesh& mesh : {kTriangle, Mesh{}}) {
    const ComparisonReport report = SequenceComparison(mesh).report();
    EXPECT_EQ(report.frames, 0U);
    EXPECT_EQ(report.extent, 0);
    EXPECT_EQ(report.rms_vertex_distance, 0);
    EXPECT_EQ(report.snr_db, kInfinity);
    EXPECT_FALSE(report.hausdorff.has_value());
  }
}

TEST(SequenceComparison, RefusesWrongInputAndDoesNotCountIt) {
  SequenceComparison comparison(kTriangle);
  const std::vector<float> two_vertices(6, 0.0F);
  EXPECT_EQ(comparison.add_frame(two_vertices, kRightTriangle).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(comparison.add_frame(kRightTriangle, two_vertices).error().code, ErrorCode::kInvalidArgument);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<float> broken = kRightTriangle;
    broken[7] = bad;
    EXPECT_EQ(comparison.add_frame(broken, kRightTriangle).error().code, ErrorCode::kInvalidInput);
    const Status status = comparison.add_frame(kRightTriangle, broken);
    EXPECT_EQ(status.error().code, ErrorCode::kInvalidInput);
    EXPECT_NE(status.error().message.find("vertex 2 "), std::string::npos);
  }
  EXPECT_EQ(comparison.report().frames, 0U);
  EXPECT_EQ(comparison.report().extent, 0);

  SequenceComparison bad_mesh(Mesh{3, {{0, 1, 3}}});
  EXPECT_EQ(bad_mesh.add_frame(kRightTriangle, kRightTriangle).error().code, ErrorCode::kInvalidInput);
  SequenceComparison bad_stride(kTriangle, {true, 0});
  EXPECT_EQ(bad_stride.add_frame(kRightTriangle, kRightTriangle).error().code, ErrorCode::kInvalidArgument);
}

TEST(SequenceComparison, HausdorffIsMeasuredAtEveryStrideThFrame) {
  std::vector<float> raised = kRightTriangle;
  for (const std::size_t z : {2U, 5U, 8U}) raised[z] = 0.5F;
  SequenceComparison comparison(kTriangle, {true, 3});
  for (int f = 0; f < 7; ++f) {
    // Only frame 3 differs among those measured (0, 3, 6); frame 4 differs more but is passed over.
    std::vector<float> decoded = f == 3 ? raised : kRightTriangle;
    if (f == 4) decoded[2] = 100;
    ASSERT_TRUE(comparison.add_frame(kRightTriangle, decoded).ok());
  }
  const ComparisonReport report = comparison.report();
  EXPECT_EQ(report.hausdorff_frames, 3U);
  EXPECT_DOUBLE_EQ(report.hausdorff.value(), 0.5);
  EXPECT_DOUBLE_EQ(report.relative_hausdorff.value(), 0.1);
}

TEST(SequenceComparison, HausdorffIsAbsentUnlessAskedForAndWithoutFaces) {
  EXPECT_FALSE(compare(kTriangle, {kRightTriangle}, {kRightTriangle}).hausdorff.has_value());
  const ComparisonReport no_faces = compare(Mesh{3, {}}, {kRightTriangle}, {kRightTriangle}, {true, 1});
  EXPECT_FALSE(no_faces.hausdorff.has_value());
  EXPECT_EQ(no_faces.hausdorff_frames, 0U);
}

TEST(SequenceComparison, ReportsBothDirectionsOfTheHausdorffDistance) {
  // A unit square whose corner (1, 1) collapses onto (1, 0): half of the square is gone, and nothing is new.
  const Mesh square{4, {{0, 1, 3}, {1, 2, 3}}};
  const std::vector<float> original = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<float> decoded = {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0};
  const ComparisonReport report = compare(square, {original}, {decoded}, {true, 1});
  EXPECT_NEAR(report.hausdorff_original_to_decoded.value(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(report.hausdorff_decoded_to_original.value(), 0, 1e-12);
  EXPECT_EQ(report.hausdorff, report.hausdorff_original_to_decoded);
}

TEST(Rates, CountTheWholeFile) {
  // 1200 bytes for 100 vertices and 8 frames: 9600 bits for 800 vertices and 2400 coordinates.
  EXPECT_DOUBLE_EQ(bits_per_vertex_and_frame(1200, 100, 8), 12);
  EXPECT_DOUBLE_EQ(bits_per_coordinate(1200, 100, 8), 4);
  EXPECT_EQ(bits_per_coordinate(1200, 100, 0), 0);
  EXPECT_EQ(bits_per_vertex_and_frame(1200, 0, 8), 0);
}

}  // namespace
}  // namespace tvg
