#pragma once
#include "bench/measure/regions.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <tvg/encoder.hpp>

// Rate curves of one sequence, with and without marks.
namespace tvg::bench {

/// The figures of an encoding, all better when smaller.
enum Figure : std::size_t { kRms, kMoving, kDeforming, kSted, kQuadric, kFigures };
constexpr std::array<const char*, kFigures> kFigureNames = {"RMS", "RMS, moving", "RMS, deforming", "STED",
                                                            "quadric"};

/// One encoding: what it costs and how far it is off. RMS is of a coordinate, relative to the diagonal.
struct Point {
  double bits = 0;  ///< of the fine lattice, log2(extent / step)
  double bytes = 0;
  std::array<double, kFigures> figures{};
};

/// A way of choosing vertices, encoded with several steps; points by ascending bytes.
struct Curve {
  std::string name;
  std::vector<Point> points;

  /// The figures at so many bytes: linear between the logarithms of its points, and beyond its ends.
  std::array<double, kFigures> at(double bytes) const;
};

/// A sequence, where its figures are counted, and what it is encoded with.
struct Experiment {
  std::string name;
  Sequence sequence;
  std::optional<JointTracks> joints;
  double extent = 0;  ///< longest side of the box around all frames
  Regions regions;
  std::uint32_t gop_frames = 50;
  int coarser_bits = 2;  ///< of hybrid encodings: B2 - B1
  Mode mode = Mode::kElp;
};

/// Completes an experiment with extent and regions.
Experiment prepare(std::string name, Sequence sequence, std::optional<JointTracks> joints,
                   std::uint32_t gop_frames, int coarser_bits, Mode mode);

/// Encodes and decodes with these fine bits, which need not be whole; without marks, all vertices alike.
Point run(const Experiment& experiment, double bits, const std::optional<Importance>& marks);

Curve run_curve(const Experiment& experiment, const std::string& name, const std::vector<double>& bits,
                const std::optional<Importance>& marks);

/// Switching in time between two encodings, so that the mean costs `bytes`: squared errors, STED and quadric
/// errors mix in proportion.
Point time_sharing(const Point& coarse, const Point& fine, double bytes);

/// Marks drawn by lot.
Importance random_marks(const Experiment& experiment, double share, std::uint32_t seed);

}  // namespace tvg::bench
