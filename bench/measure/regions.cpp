#include "bench/measure/regions.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace tvg::bench {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kFrameStride = 5;
// Less than this is rounding: a thousandth of an edge, squared, and what float32 positions leave.
constexpr double kLeastDeformation = 1e-6;

Vector3d point(const FramePositions& frame, std::size_t vertex) {
  return Eigen::Map<const Eigen::Vector3f>(frame.data() + 3 * vertex).cast<double>();
}

/// The highest values, of those above `least`.
std::vector<std::uint8_t> highest(const std::vector<double>& values, double least) {
  std::vector<std::uint32_t> ranked(values.size());
  std::iota(ranked.begin(), ranked.end(), 0U);
  std::stable_sort(ranked.begin(), ranked.end(), [&](auto a, auto b) { return values[a] > values[b]; });
  ranked.resize(static_cast<std::size_t>(kRegionShare * static_cast<double>(values.size())));
  std::vector<std::uint8_t> inside(values.size(), 0);
  for (const std::uint32_t v : ranked) inside[v] = values[v] > least ? 1 : 0;
  return inside;
}

std::vector<double> ways(std::span<const FramePositions> frames) {
  std::vector<double> way(frames[0].size() / 3, 0.0);
  for (std::size_t f = 1; f < frames.size(); ++f) {
    for (std::size_t v = 0; v < way.size(); ++v)
      way[v] += (point(frames[f], v) - point(frames[f - 1], v)).norm();
  }
  return way;
}

/// What is left of the edges at a vertex when the rotation that fits best is taken out, relative to them.
double residual(const FramePositions& rest, const FramePositions& frame, std::size_t vertex,
                const std::vector<std::uint32_t>& neighbours) {
  Matrix3d covariance = Matrix3d::Zero();
  double energy = 0, now = 0;
  for (const std::uint32_t n : neighbours) {
    const Vector3d e = point(rest, n) - point(rest, vertex);
    const Vector3d moved = point(frame, n) - point(frame, vertex);
    covariance += moved * e.transpose();
    energy += e.squaredNorm();
    now += moved.squaredNorm();
  }
  if (!(energy > 0)) return 0;
  // sum |e' - R e|^2 = sum |e'|^2 + sum |e|^2 - 2 tr(R^T S), and the best R makes the trace the sum of the
  // singular values, the least of them negative where S reflects.
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(covariance.transpose() * covariance, Eigen::EigenvaluesOnly);
  const Vector3d singular = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();  // ascending
  const double sign = covariance.determinant() < 0 ? -1 : 1;
  return std::max(0.0, energy + now - 2 * (singular[2] + singular[1] + sign * singular[0])) / energy;
}

}  // namespace

Regions find_regions(const Sequence& sequence, std::uint32_t gop_frames) {
  std::vector<std::vector<std::uint32_t>> neighbours(sequence.mesh.vertex_count);
  for (const auto& [a, b, c] : sequence.mesh.faces) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      neighbours[from].push_back(to);
      neighbours[to].push_back(from);
    }
  }
  Regions regions;
  regions.gop_frames = gop_frames;
  for (std::size_t first = 0; first < sequence.frames.size(); first += gop_frames) {
    const std::size_t count = std::min<std::size_t>(gop_frames, sequence.frames.size() - first);
    const auto frames = std::span(sequence.frames).subspan(first, count);
    regions.moving.push_back(highest(ways(frames), 0));
    std::vector<double> deformation(sequence.mesh.vertex_count, 0.0);
    for (std::size_t f = kFrameStride - 1; f < count; f += kFrameStride) {
      for (std::size_t v = 0; v < deformation.size(); ++v) {
        deformation[v] += residual(frames[0], frames[f], v, neighbours[v]);
      }
    }
    regions.deforming.push_back(
        highest(deformation, kLeastDeformation * static_cast<double>(count / kFrameStride)));
  }
  return regions;
}

}  // namespace tvg::bench
