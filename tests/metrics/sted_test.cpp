#include "metrics/sted.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include <tvg/metrics.hpp>

namespace tvg {
namespace {

const Mesh kTriangle{3, {{0, 1, 2}}};
const std::vector<float> kRightTriangle = {0, 0, 0, 3, 0, 0, 0, 4, 0};

using Frames = std::vector<std::vector<float>>;

ComparisonReport compare(const Mesh& mesh, const Frames& original, const Frames& decoded) {
  SequenceComparison comparison(mesh);
  for (std::size_t f = 0; f < original.size(); ++f) {
    EXPECT_TRUE(comparison.add_frame(original[f], decoded[f]).ok());
  }
  return comparison.report();
}

/// A grid of 20 x 20 vertices that waves for 12 frames, with noise of this size added.
struct Waves {
  Mesh mesh{400, {}};
  Frames frames;

  explicit Waves(float noise = 0) {
    for (std::uint32_t v = 0; v + 21 < 400; ++v) {
      if (v % 20 == 19) continue;
      mesh.faces.push_back({v, v + 1, v + 21});
      mesh.faces.push_back({v, v + 21, v + 20});
    }
    std::mt19937 random(3);
    std::normal_distribution<float> draw;
    for (int f = 0; f < 12; ++f) {
      std::vector<float> frame;
      for (int v = 0; v < 400; ++v) {
        const auto x = static_cast<float>(v % 20), y = static_cast<float>(v / 20);
        for (const float value : {x, y, std::sin(0.5F * x + 0.3F * static_cast<float>(f))}) {
          frame.push_back(value + noise * draw(random));
        }
      }
      frames.push_back(frame);
    }
  }

  Frames turned_and_moved(double angle, float shift) const {
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    Frames result = frames;
    for (std::vector<float>& frame : result) {
      for (std::size_t i = 0; i < frame.size(); i += 3) {
        const float x = frame[i], y = frame[i + 1];
        frame[i] = c * x - s * y + shift;
        frame[i + 1] = s * x + c * y;
        frame[i + 2] -= shift;
      }
    }
    return result;
  }
};

TEST(Sted, SpatialPartOfATriangleWorkedByHand) {
  // Lengths 3, 4 and 5. Moving vertex 1 to (6, 0, 0) makes them 6, 4 and sqrt(52): errors 1, 0, sqrt(52) / 5
  // - 1. Every vertex has all three edges.
  const std::vector<float> decoded = {0, 0, 0, 6, 0, 0, 0, 4, 0};
  const double third = std::sqrt(52.0) / 5 - 1;
  const double mean = (3 * 1 + 5 * third) / 12;
  const double variance =
      (3 * (1 - mean) * (1 - mean) + 4 * mean * mean + 5 * (third - mean) * (third - mean)) / 12;
  const ComparisonReport report = compare(kTriangle, {kRightTriangle}, {decoded});
  EXPECT_NEAR(report.sted_spatial, std::sqrt(variance), 1e-12);
  EXPECT_EQ(report.sted_temporal, 0);
  EXPECT_DOUBLE_EQ(report.sted, report.sted_spatial);
}

TEST(Sted, TemporalPartOfAPathWorkedByHand) {
  // The diagonal is 5, so a frame is 0.01 long. Vertex 0 goes 0.3 and 0.4 in the original, and 0.3 and 0 as
  // decoded; the others rest in both.
  ASSERT_EQ(kStedFrameLength, 0.002);
  const auto with_first_at = [](float x) {
    std::vector<float> frame = kRightTriangle;
    frame[2] = x;
    return frame;
  };
  const Frames original = {with_first_at(0), with_first_at(0.3F), with_first_at(0.7F)};
  const Frames decoded = {with_first_at(0), with_first_at(0.3F), with_first_at(0.3F)};
  const double first = std::hypot(0.3, 0.01), second = std::hypot(0.4, 0.01);
  const double error = (second - 0.01) / second;
  const double mean = second * error / (first + second);
  const double variance = (first * mean * mean + second * (error - mean) * (error - mean)) / (first + second);
  const ComparisonReport report = compare(kTriangle, original, decoded);
  // Three vertices, two steps, and only one set of edges deviates.
  EXPECT_NEAR(report.sted_temporal, std::sqrt(variance) / 6, 1e-6);
  EXPECT_NEAR(report.sted, std::hypot(report.sted_spatial, kStedTemporalWeight * report.sted_temporal),
              1e-12);
}

TEST(Sted, IsZeroForIdenticalSequences) {
  const Waves waves;
  const ComparisonReport report = compare(waves.mesh, waves.frames, waves.frames);
  EXPECT_EQ(report.sted, 0);
  EXPECT_EQ(report.sted_spatial, 0);
  EXPECT_EQ(report.sted_temporal, 0);
}

TEST(Sted, DoesNotSeeThatEverythingIsElsewhere) {
  const Waves waves;
  const ComparisonReport moved = compare(waves.mesh, waves.frames, waves.turned_and_moved(0, 64));
  EXPECT_NEAR(moved.sted, 0, 1e-4);
  EXPECT_GT(moved.rms_vertex_distance, 50);
  const ComparisonReport turned = compare(waves.mesh, waves.frames, waves.turned_and_moved(1, 8));
  EXPECT_NEAR(turned.sted_spatial, 0, 1e-5);
}

TEST(Sted, GrowsWithNoise) {
  const Waves waves;
  double last = 0;
  for (const float noise : {0.001F, 0.004F, 0.016F, 0.064F}) {
    const ComparisonReport report = compare(waves.mesh, waves.frames, Waves(noise).frames);
    EXPECT_GT(report.sted_spatial, 2 * last);
    EXPECT_GT(report.sted_temporal, 0);
    last = report.sted_spatial;
  }
}

TEST(Sted, SeesNoiseRatherThanASmoothErrorOfTheSameSize) {
  const Waves waves;
  Frames bent = waves.frames;
  for (std::vector<float>& frame : bent) {
    for (std::size_t i = 0; i < frame.size(); i += 3) frame[i + 2] += 0.05F * std::sin(0.3F * frame[i + 1]);
  }
  const ComparisonReport smooth = compare(waves.mesh, waves.frames, bent);
  const ComparisonReport noisy = compare(waves.mesh, waves.frames, Waves(0.02F).frames);
  ASSERT_NEAR(smooth.rms_vertex_distance, noisy.rms_vertex_distance, 0.3 * noisy.rms_vertex_distance);
  EXPECT_GT(noisy.sted_spatial, 5 * smooth.sted_spatial);
}

TEST(Sted, ForgetsStepsThatHaveLeftTheWindow) {
  // One jump of one vertex is inside kStedWindow windows, however long the sequence is.
  const auto temporal_sum = [](std::size_t frames) {
    Frames original(frames, kRightTriangle), decoded = original;
    for (std::size_t f = 3; f < frames; ++f) decoded[f][2] = 1;
    return compare(kTriangle, original, decoded).sted_temporal * 3 * static_cast<double>(frames - 1);
  };
  EXPECT_GT(temporal_sum(20), 0);
  EXPECT_NEAR(temporal_sum(20), temporal_sum(40), 1e-9 * temporal_sum(40));
  EXPECT_GT(temporal_sum(7), 0.5 * temporal_sum(20));
}

TEST(Sted, IsDefinedForAnyFaces) {
  const Mesh mesh{5, {{0, 0, 1}, {2, 2, 2}, {0, 1, 2}, {2, 1, 0}}};
  const Frames original(2, std::vector<float>(15, 1.0F));
  Frames decoded = original;
  decoded[1][4] = 7;
  const ComparisonReport report = compare(mesh, original, decoded);
  EXPECT_EQ(report.sted_spatial, 0) << "edges without length are left out";
  EXPECT_TRUE(std::isfinite(report.sted));
  EXPECT_EQ(compare(Mesh{5, {}}, original, decoded).sted_spatial, 0);
}

}  // namespace
}  // namespace tvg
