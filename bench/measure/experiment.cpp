#include "bench/measure/experiment.hpp"

#include "bench/sequences.hpp"
#include "codecs/in_memory.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace tvg::bench {

namespace {

constexpr int kMostBits = 24;

/// Sums of squared differences of coordinates, and their number.
struct SquaredError {
  double sum = 0;
  double count = 0;

  double root_mean() const { return count > 0 ? std::sqrt(sum / count) : 0; }
};

SquaredError error_inside(const Experiment& experiment, const std::vector<FramePositions>& decoded,
                          const std::vector<std::vector<std::uint8_t>>& region) {
  SquaredError error;
  for (std::size_t f = 0; f < decoded.size(); ++f) {
    const std::vector<std::uint8_t>& inside = region[f / experiment.regions.gop_frames];
    const FramePositions& original = experiment.sequence.frames[f];
    for (std::size_t i = 0; i < original.size(); ++i) {
      if (inside[i / 3] == 0) continue;
      const double difference = double{original[i]} - decoded[f][i];
      error.sum += difference * difference;
      ++error.count;
    }
  }
  return error;
}

}  // namespace

std::array<double, kFigures> Curve::at(double bytes) const {
  std::size_t upper = 1;
  while (upper + 1 < points.size() && points[upper].bytes < bytes) ++upper;
  const Point& a = points[upper - 1];
  const Point& b = points[upper];
  const double share = std::log(bytes / a.bytes) / std::log(b.bytes / a.bytes);
  std::array<double, kFigures> figures{};
  for (std::size_t k = 0; k < kFigures; ++k) {
    figures[k] = a.figures[k] * std::pow(b.figures[k] / a.figures[k], share);
  }
  return figures;
}

Experiment prepare(std::string name, Sequence sequence, std::optional<JointTracks> joints,
                   std::uint32_t gop_frames, int coarser_bits, Mode mode) {
  Experiment experiment{
      std::move(name), std::move(sequence), std::move(joints), 0, {}, gop_frames, coarser_bits, mode};
  // An exact copy, compared for the sake of the box.
  experiment.extent = compare(experiment.sequence, experiment.sequence.frames).extent;
  experiment.regions = find_regions(experiment.sequence, gop_frames);
  return experiment;
}

Point run(const Experiment& experiment, double bits, const std::optional<Importance>& marks) {
  EncodeOptions options;
  options.mode = experiment.mode;
  options.period_frames = experiment.gop_frames;
  options.step = experiment.extent / std::exp2(bits);
  options.fine_bits = kMostBits;
  options.coarse_bits = marks ? kMostBits - experiment.coarser_bits : kMostBits;
  options.gop_frames = experiment.gop_frames;
  if (marks) options.importance = *marks;
  SequenceSource source(experiment.sequence, experiment.joints ? &*experiment.joints : nullptr);
  const std::vector<std::uint8_t> stream = encode_to_memory(source, options);
  std::vector<FramePositions> decoded(experiment.sequence.frames.size(),
                                      FramePositions(experiment.sequence.frames[0].size()));
  decode_from_memory(stream, decoded);
  const ComparisonReport report = compare(experiment.sequence, decoded);
  Point point{bits, static_cast<double>(stream.size()), {}};
  point.figures[kRms] = report.relative_rms_coordinate_error;
  point.figures[kMoving] =
      error_inside(experiment, decoded, experiment.regions.moving).root_mean() / report.diagonal;
  point.figures[kDeforming] =
      error_inside(experiment, decoded, experiment.regions.deforming).root_mean() / report.diagonal;
  point.figures[kSted] = report.sted;
  point.figures[kQuadric] = report.mean_quadric_error / (report.diagonal * report.diagonal);
  return point;
}

Curve run_curve(const Experiment& experiment, const std::string& name, const std::vector<double>& bits,
                const std::optional<Importance>& marks) {
  Curve curve{name, {}};
  for (const double fine : bits) curve.points.push_back(run(experiment, fine, marks));
  return curve;
}

Point time_sharing(const Point& coarse, const Point& fine, double bytes) {
  const double share = (bytes - coarse.bytes) / (fine.bytes - coarse.bytes);
  Point mixed{0, bytes, {}};
  for (std::size_t k = 0; k < kFigures; ++k) {
    const double power = k == kSted || k == kQuadric ? 1 : 2;
    mixed.figures[k] =
        std::pow((1 - share) * std::pow(coarse.figures[k], power) + share * std::pow(fine.figures[k], power),
                 1 / power);
  }
  return mixed;
}

Importance random_marks(const Experiment& experiment, double share, std::uint32_t seed) {
  Importance marks;
  marks.share = share;
  marks.criteria = {{"weights", 1.0}};
  std::mt19937 random(seed);
  for (std::uint32_t v = 0; v < experiment.sequence.mesh.vertex_count; ++v) {
    marks.weights.push_back(static_cast<double>(random()));
  }
  return marks;
}

}  // namespace tvg::bench
