#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/types.hpp>

// How far a decoded sequence lies from its original (design: metrics). Frames are compared one at a time, so
// that memory does not grow with the number of frames.
namespace tvg {

struct ComparisonSettings {
  /// Measure the Hausdorff distance too; it costs about 20 ms per frame of 10,000 vertices.
  bool hausdorff = false;
  /// Measure it at every frame whose number is a multiple of this; at least 1.
  std::uint32_t hausdorff_stride = 1;
};

/// Distances are in the mesh's units; `relative_*` are divided by `diagonal`.
/// A relative figure is infinite where only its divisor is zero, and 0 where both are.
struct ComparisonReport {
  std::uint64_t frames = 0;  ///< frames compared; with none, all figures are 0 (snr_db infinite)
  std::uint64_t vertices = 0;

  /// The bounding box over all frames of the original: its longest side and its diagonal.
  double extent = 0;
  double diagonal = 0;

  double max_coordinate_error = 0;  ///< largest |difference| of one coordinate
  double max_vertex_distance = 0;   ///< largest distance between a vertex and its decoded self
  double rms_coordinate_error = 0;  ///< root mean square over all coordinates of all frames
  double rms_vertex_distance =
      0;  ///< root mean square over all vertices of all frames: sqrt(3) times as large
  double mean_coordinate_error = 0;  ///< mean |difference| of a coordinate

  double relative_max_coordinate_error = 0;
  double relative_max_vertex_distance = 0;
  double relative_rms_coordinate_error = 0;
  double relative_rms_vertex_distance = 0;

  std::uint64_t worst_frame = 0;   ///< where max_vertex_distance is reached first
  std::uint32_t worst_vertex = 0;  ///< the vertex there

  /// The paper's signal to noise ratio, 20 log10(2^B / mean absolute error in lattice units), in dB. Infinite
  /// for identical sequences, negative infinite where a sequence without extent has errors (both are null in
  /// JSON).
  double snr_db = 0;

  /// 100 |A - A'|_F / |A - E(A)|_F, A the original's coordinates over all frames, E(A) the centroid in each
  /// frame. 0 for identical sequences; infinite where every frame of the original is a single point and A'
  /// differs.
  double kg_percent = 0;

  /// The paper's quadric error (Eq. 8): the sum, over the original's faces around a vertex, of the squared
  /// distance of the decoded vertex from the face's plane; faces without area add nothing. In squared mesh
  /// units.
  double mean_quadric_error = 0;  ///< over all vertices of all frames
  double max_quadric_error = 0;

  /// A STED-type metric (after Vasa and Skala 2011): how unevenly edge lengths are off, in space and over
  /// time, in relative terms; metrics/sted.hpp defines both parts and their constants. Insensitive to a
  /// translation of everything; 0 for identical sequences and without faces (spatial) or a second frame
  /// (temporal).
  double sted = 0;           ///< sqrt(spatial^2 + (0.127 temporal)^2)
  double sted_spatial = 0;   ///< mean deviation of relative edge-length errors around a vertex
  double sted_temporal = 0;  ///< the same along the path of a vertex, over 5 frames

  /// Hausdorff distance between the surfaces, the largest over the frames measured: from every vertex in use
  /// and every face's centroid of one to the nearest point of the other. Absent when it was not asked for, no
  /// frame was measured, or the mesh has no faces.
  std::optional<double> hausdorff;                      ///< the larger of the two directions
  std::optional<double> relative_hausdorff;             ///< divided by `diagonal`
  std::optional<double> hausdorff_original_to_decoded;  ///< one direction
  std::optional<double> hausdorff_decoded_to_original;  ///< the other
  std::uint64_t hausdorff_frames = 0;                   ///< frames it was measured at
};

/// Compares two sequences of the same mesh, frame by frame.
class SequenceComparison {
 public:
  explicit SequenceComparison(const Mesh& mesh, const ComparisonSettings& settings = {});
  ~SequenceComparison();
  SequenceComparison(SequenceComparison&&) noexcept;
  SequenceComparison& operator=(SequenceComparison&&) noexcept;

  /// Takes the next frame of both sequences: float32 [vertex][xyz], 3 * vertex_count values each.
  /// Fails with kInvalidArgument where a size or a setting is wrong, kInvalidInput where a position is not
  /// finite or the mesh names a vertex it does not have; a frame that fails is not counted.
  Status add_frame(std::span<const float> original, std::span<const float> decoded);

  /// The figures over the frames taken so far.
  ComparisonReport report() const;

 private:
  class Accumulator;
  std::unique_ptr<Accumulator> accumulator_;
};

struct SurfaceSettings {
  /// Points of each surface that are held against the other: spread over its faces by their area, evenly, the
  /// same ones in every run. At least 1.
  std::uint32_t samples = 10000;
  /// Frames whose number is a multiple of this are measured; at least 1.
  std::uint32_t stride = 1;
};

/// How far two surfaces are apart in one frame, in the meshes' units. Each point of a surface is as far from
/// the other as the nearest point there, wherever that lies in the mesh.
struct SurfaceDistances {
  std::uint64_t frame = 0;
  double rms_to_other = 0;        ///< root mean square over the samples of the original
  double rms_to_original = 0;     ///< the same over the samples of the other
  double hausdorff_to_other = 0;  ///< the largest over the original's samples and vertices in use
  double hausdorff_to_original = 0;

  /// The larger of the two directions.
  double rms() const { return rms_to_other > rms_to_original ? rms_to_other : rms_to_original; }
  double hausdorff() const {
    return hausdorff_to_other > hausdorff_to_original ? hausdorff_to_other : hausdorff_to_original;
  }
};

/// Distances are in the meshes' units; `relative_*` are divided by `diagonal`, as those of ComparisonReport.
struct SurfaceReport {
  std::uint64_t frames = 0;  ///< taken; with none measured, all figures are 0
  std::uint32_t original_vertices = 0, other_vertices = 0;
  std::uint64_t original_faces = 0, other_faces = 0;
  double diagonal = 0;  ///< of the bounding box over all frames of the original

  double rms = 0;        ///< root mean square over all frames measured, of the direction where it is larger
  double worst_rms = 0;  ///< the largest rms() of a frame
  double mean_hausdorff = 0;  ///< the mean of hausdorff() over the frames measured
  double hausdorff = 0;       ///< the largest of a frame
  double relative_rms = 0, relative_worst_rms = 0, relative_mean_hausdorff = 0, relative_hausdorff = 0;
  std::uint64_t worst_rms_frame = 0, worst_hausdorff_frame = 0;  ///< where they are largest first

  std::vector<SurfaceDistances> measured;  ///< the frames measured
};

/// Compares two sequences frame by frame that show the same thing with different meshes: only the surfaces
/// count, not their vertices.
class SurfaceComparison {
 public:
  SurfaceComparison(const Mesh& original, const Mesh& other, const SurfaceSettings& settings = {});
  ~SurfaceComparison();
  SurfaceComparison(SurfaceComparison&&) noexcept;
  SurfaceComparison& operator=(SurfaceComparison&&) noexcept;

  /// The mesh of one side's frames that follow, where it changes.
  /// @{
  void set_original(const Mesh& original);
  void set_other(const Mesh& other);
  /// @}

  /// Takes the next frame of both: float32 [vertex][xyz] of the mesh of each. Fails with kInvalidArgument
  /// where a size or a setting is wrong, kInvalidInput where a position is not finite, or a mesh
  /// names a vertex it does not have, or one of the two has no faces; a frame that fails is not counted, and
  /// one in which neither has faces is, but not measured.
  Status add_frame(std::span<const float> original, std::span<const float> other);

  /// Whether add_frame() measures the next frame.
  bool measures_next() const;

  /// The figures over the frames taken so far.
  SurfaceReport report() const;

 private:
  class Accumulator;
  std::unique_ptr<Accumulator> accumulator_;
};

/// What is wrong with a surface in one frame.
struct SurfaceFaults {
  /// Pairs of faces with at most one vertex in common that pass through each other. Faces that only touch, or
  /// overlap within one plane, do not.
  std::uint64_t intersections = 0;
  /// Edges of exactly two faces that are folded: the normals of the two, both faces turned the same way
  /// round, are further apart than the angle asked for.
  std::uint64_t folds = 0;

  bool operator==(const SurfaceFaults&) const = default;
};

/// Counts the faults of a mesh with these positions [vertex][xyz]; faces without area have none. `fold` is in
/// degrees, 0 to 180. kInvalidArgument where a size or the angle is wrong, kInvalidInput where a position is
/// not finite or the mesh names a vertex it does not have.
Result<SurfaceFaults> surface_faults(const Mesh& mesh, std::span<const float> positions, double fold = 150);

/// Bits per coordinate of a file of so many bytes; 0 without coordinates.
double bits_per_coordinate(std::uint64_t bytes, std::uint64_t vertices, std::uint64_t frames);

/// Bits per vertex and frame (bpvf): three times as much.
double bits_per_vertex_and_frame(std::uint64_t bytes, std::uint64_t vertices, std::uint64_t frames);

}  // namespace tvg
