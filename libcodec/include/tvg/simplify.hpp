#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/levels.hpp>
#include <tvg/measure.hpp>
#include <tvg/types.hpp>

// Simplification of an animated mesh with one connectivity for all frames: MAPS (Lee et al. 1998), with its
// priority or with the measure in its place.
namespace tvg {

/// What says which vertices are removed first.
enum class SimplifyPriority : std::uint8_t {
  kMaps,     ///< area and curvature of the one ring, each relative to the level's largest (the paper's Eq. 7)
  kMeasure,  ///< the cost of the measure (Eq. 2): what matters least to the animation goes first
};

struct SimplifyOptions {
  /// Numbers of vertices at which a mesh is kept, strictly falling, each at least 3, at most 63 of them:
  /// removal ends at the last.
  std::vector<std::uint32_t> vertex_counts;
  /// Priorities are worked out anew on the mesh that each level begins with.
  SimplifyPriority priority = SimplifyPriority::kMeasure;
  double lambda = 0.5;    ///< of Eq. 7: weight of the area against the curvature, 0 to 1
  Importance importance;  ///< of kMeasure: the criteria whose weighted sum is the cost
  /// Degrees by which the normal of a new face may be off from that of the faces it replaces as a whole, in
  /// any frame, unless one of these was further off there; up to 180. A boundary may turn by half of it where
  /// a vertex is taken out of it.
  double largest_turn = 75;
  /// In every frame given no face may fold; in so many of them, evenly spread, none may come to intersect
  /// another where none did before. 0 for none.
  std::uint32_t intersection_frames = 24;
};

/// A point on a mesh: in a face, by barycentric coordinates.
struct SurfacePlace {
  std::uint32_t face = 0;
  std::array<double, 3> weights{};  ///< [corner] of sum 1, none below 0
};

/// A mesh over some of the vertices of another, and where the others have come to lie on it.
struct SimplifiedMesh {
  Mesh mesh;
  std::vector<std::uint32_t> vertices;  ///< [vertex] the original's, ascending
  std::vector<SurfacePlace> places;     ///< [vertex of the original] in a face of `mesh`
};

/// What happened at a level of MAPS, the finest first.
struct SimplifyLevel {
  std::uint32_t vertices = 0, faces = 0;  ///< that were left after it
  std::uint32_t removed = 0;
  std::uint32_t refused = 0;  ///< chosen, but there was no way to fill their hole without a fold
  /// [frame] The paper's Eq. 8 summed over all vertices removed up to this level: the squared distances of
  /// each from the planes of the original's faces around it, when it lies at its place on the simplified
  /// mesh; in a frame that is scaled so that the mesh's largest extent over all frames is 1.
  std::vector<double> quadric_error;
};

/// How each hole was filled: what remesh() goes back by.
class RemovalHistory;

struct Simplification {
  /// [vertex_counts] With more vertices than asked for where no more could be removed without a fold.
  std::vector<SimplifiedMesh> meshes;
  std::vector<SimplifyLevel> levels;
  std::vector<std::uint32_t> removed;  ///< vertices of the original in the order they were removed
  /// What the encoder makes a pyramid of, with the meshes of `vertex_counts` as coarser ones.
  MeshLevels mesh_levels;
  std::shared_ptr<const RemovalHistory> history;
};

/// Hears how many vertices are removed, and how many are to be.
using SimplifyProgress = std::function<void(std::uint32_t removed, std::uint32_t total)>;

/// Simplifies a mesh that moves. Vertices without a face go first; those of edges where more than two faces
/// meet, or faces disagree about their sense, and those where fans of faces meet in a point stay. Boundary
/// loops and components are kept. `frames` are [frame][vertex][xyz], at least one: the whole sequence, or
/// frames of it that stand for all; `joints` are [frame][joint][xyz], empty unless a criterion uses them.
/// kInvalidArgument for options out of range and where check_importance() fails, kInvalidInput for frames of
/// a wrong size or that are not finite, and for a mesh without a face that has an area.
Result<Simplification> simplify(const Mesh& mesh, std::span<const FramePositions> frames,
                                const Skeleton& skeleton, std::span<const std::vector<float>> joints,
                                const SimplifyOptions& options, const SimplifyProgress& progress = {});

/// Where the vertices of `mesh` with these positions [vertex][xyz] put the places, [place][xyz].
void positions_of(const Mesh& mesh, std::span<const SurfacePlace> places, std::span<const float> positions,
                  std::span<float> result);

struct RemeshOptions {
  std::uint32_t levels = 2;  ///< how often faces are cut in four, at most kMaxRemeshLevels
  /// Where given, only edges are cut, and faces with them, from which the original is further away than this
  /// in any frame, at their middle or that of a face beside them; in the mesh's units.
  std::optional<double> largest_distance;
};

inline constexpr std::uint32_t kMaxRemeshLevels = 10;

/// A mesh whose connectivity comes from cutting the faces of a simplified one, without T-vertices, and whose
/// vertices lie on the original.
struct Remesh {
  Mesh mesh;                         ///< the simplified mesh's vertices come first, in its order
  std::vector<SurfacePlace> places;  ///< [vertex] in a face of the original: see positions_of()
};

/// Cuts up the last, and smallest, mesh of a simplification of `mesh`. `frames` are those it was simplified
/// by, or some of them; none are needed without a largest distance. kInvalidArgument for options out of
/// range, for a mesh or frames of a wrong size, and where there would be more faces than a mesh can have.
Result<Remesh> remesh(const Simplification& simplification, const Mesh& mesh,
                      std::span<const FramePositions> frames, const RemeshOptions& options);

}  // namespace tvg
