#pragma once
#include "metrics/hausdorff.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

// A spatio-temporal edge difference after Vasa and Skala (2011): what the eye sees of an error is not how far
// a vertex is off, but that neighbours, or one vertex in successive frames, are off by different amounts.
namespace tvg {

/// Virtual edges that a window holds: the deviation over time is that of so many steps from frame to frame.
constexpr std::size_t kStedWindow = 5;
/// What one frame is in length: this share of the diagonal of the original's first frame. It keeps the
/// virtual edge of a vertex at rest from having no length.
constexpr double kStedFrameLength = 0.002;
/// Weight of the temporal part against the spatial one.
constexpr double kStedTemporalWeight = 0.127;

/// Adds up both parts frame by frame; memory is in proportion to kStedWindow frames.
///
/// An edge of length l in the original and l' in the decoded frame has the relative error e = |l - l'| / l;
/// edges without length in the original are left out. The deviation of a set of edges is
/// sqrt(sum of l (e - m)^2 / sum of l), m = sum of l e / sum of l.
/// Spatial: the set of a vertex is the edges of the faces around it (topological distance 1); the mean
/// deviation over all vertices with such a set and all frames.
/// Temporal: the set is the last kStedWindow virtual edges (fewer at the start) from a vertex to itself one
/// frame on, of length sqrt(way^2 + (kStedFrameLength * diagonal)^2); the mean deviation over all vertices
/// and all frames but the first.
class EdgeDifference {
 public:
  /// The faces' indices are valid.
  explicit EdgeDifference(const Mesh& mesh);

  /// Takes the next frame of both sequences; vertex_count points each.
  void add_frame(const Points& original, const Points& decoded);

  double spatial() const;
  double temporal() const;
  /// sqrt(spatial^2 + kStedTemporalWeight^2 * temporal^2)
  double combined() const;

 private:
  void add_spatial(const Points& original, const Points& decoded);
  void add_temporal(const Points& original, const Points& decoded);

  std::vector<std::array<std::uint32_t, 2>> edges_;  ///< [edge]
  std::vector<std::size_t> begin_;                   ///< [vertex], and one past the last: into vertex_edges_
  std::vector<std::uint32_t> vertex_edges_;
  std::vector<double> length_, error_;  ///< [edge], of the present frame
  Points last_original_, last_decoded_;
  /// Virtual edges, [step modulo kStedWindow][vertex].
  std::array<std::vector<double>, kStedWindow> step_length_, step_error_;
  double frame_length_ = 0;
  std::size_t frames_ = 0;
  double spatial_sum_ = 0, temporal_sum_ = 0;
  double spatial_count_ = 0, temporal_count_ = 0;
};

}  // namespace tvg
