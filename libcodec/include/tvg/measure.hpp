#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/skeleton.hpp>
#include <tvg/source.hpp>
#include <tvg/types.hpp>

// The measure (the paper's Eq. 1 to 6): how much each vertex matters to the animation, as a weighted sum of
// criteria. The encoder asks it once per GOP; streams carry its flags, so decoders know nothing of it.
namespace tvg {

/// A criterion and its weight in the cost (Eq. 2).
struct CriterionWeight {
  std::string name;   ///< one of criterion_descriptions()
  double weight = 1;  ///< finite; a negative one favours the vertices with low values
};

/// Which joint a vertex belongs to.
enum class JointRegion : std::uint8_t {
  kNearest,   ///< the nearest in the first of the frames measured; of equally near ones the first
  kHeaviest,  ///< the one of the largest skin weight, where the skeleton knows it
};

/// Of curv and curvature-norm.
struct CurvatureOptions {
  double alpha = 0.5;  ///< Eq. 3: weight of the change against the mean, 0 to 1
};

/// Of skel.
struct SkeletonOptions {
  double alpha = 1;  ///< Eq. 6: the value of vertices at dynamic joints, 0 to 1; others have 1 - alpha
  /// A joint is dynamic when its sum of angle changes is above this many degrees per frame. Where absent:
  /// above a quarter of the strongest joint's sum, and above 0.1 degrees per frame.
  std::optional<double> threshold;
  JointRegion region = JointRegion::kNearest;
};

/// Of distance.
struct DistanceOptions {
  std::array<double, 3> viewpoint = {};  ///< [xyz] in the mesh's units
};

constexpr std::uint32_t kMaxSmoothing = 1000;

/// What makes vertices important (Algorithm 1).
struct Importance {
  double share = 0.35;              ///< the share of vertices with the highest cost, 0 to 1
  std::optional<double> threshold;  ///< instead: every vertex whose cost is above this
  std::vector<CriterionWeight> criteria = {{"curv", 1.0}};  ///< the cost is their weighted sum; at least one

  /// How often the cost is averaged over each vertex and its neighbours before vertices are flagged, at most
  /// kMaxSmoothing. Vertices are predicted from their neighbours, so marks in one piece cost fewer bytes than
  /// scattered ones.
  std::uint32_t smoothing = 0;

  // What single criteria are told, under their names.
  CurvatureOptions curv;  ///< of curv and curvature-norm
  SkeletonOptions skel;
  DistanceOptions distance;
  std::vector<double> weights;  ///< of weights: the values themselves, [vertex], finite

  /// Mark a GOP by the frames of the GOP before it, the first by its own first frame: nothing has to wait for
  /// frames that are still to come.
  bool low_delay = false;
};

struct CriterionDescription {
  std::string_view name;
  std::string_view description;  ///< one line
};

/// Every criterion there is.
std::vector<CriterionDescription> criterion_descriptions();

/// Whether one of the criteria looks at the skeleton.
bool uses_skeleton(const Importance& importance);

/// kInvalidArgument, with what would be right, unless all values are in range and the criteria find what they
/// need in this mesh and this skeleton.
Status check_importance(const Importance& importance, const Mesh& mesh, const Skeleton& skeleton);

/// What SKEL sees of a joint.
struct JointMotion {
  /// The sum, over every pair of segments that meet at the joint and over the frames, of the absolute change
  /// of the angle between them, in degrees.
  double angle_sum = 0;
  bool dynamic = false;
};

/// The measure of a run of frames.
struct Measure {
  std::vector<double> cost;         ///< [vertex]
  std::vector<std::uint8_t> flags;  ///< [vertex]: 1 important, 0 not
  std::vector<JointMotion> joints;  ///< [joint]; empty unless a criterion uses the skeleton
};

class Topology;

/// Measures one run of frames of a mesh after the other; what only depends on the mesh is worked out once.
/// Mesh, skeleton and importance must outlive it.
class Measurer {
 public:
  Measurer(const Mesh& mesh, const Skeleton& skeleton, const Importance& importance);
  ~Measurer();

  /// As the function measure() below. Several threads may call it at once.
  Result<Measure> measure(std::span<const FramePositions> frames,
                          std::span<const std::vector<float>> joints) const;

 private:
  std::unique_ptr<const Topology> topology_;
  const Skeleton& skeleton_;
  const Importance& importance_;
};

/// Measures `frames` ([frame][vertex][xyz], at least one). `joints` ([frame][joint][xyz]) may be empty unless
/// a criterion uses the skeleton. Fails with kInvalidArgument where check_importance() does, and where there
/// are fewer frames of joints than of vertices or a frame has a wrong size.
Result<Measure> measure(const Mesh& mesh, std::span<const FramePositions> frames, const Skeleton& skeleton,
                        std::span<const std::vector<float>> joints, const Importance& importance);

/// The measure of one GOP of a sequence, and the frames it is about.
struct GopMeasure {
  std::uint64_t first_frame = 0;               ///< counted from the source's first
  std::span<const FramePositions> frames;      ///< [frame][vertex][xyz], valid during the call
  std::span<const std::vector<float>> joints;  ///< [frame][joint][xyz]; empty unless a criterion uses them
  std::uint64_t measured_frames = 0;           ///< how many were looked at: its own, or the GOP's before
  Measure measure;                             ///< as encode() has it with the same importance
};

using GopMeasureSink = std::function<Status(const GopMeasure&)>;

/// Measures a source from its present frame to its end in GOPs of `gop_frames` frames, as encode() cuts them,
/// and passes each to `sink`, whose error ends it. One GOP is in memory at a time, with low_delay two. Fails
/// as encode() does where the mesh, the frames or the importance are not as they should be.
Status measure_gops(FrameSource& source, std::uint32_t gop_frames, const Importance& importance,
                    const GopMeasureSink& sink);

}  // namespace tvg
