#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

// How what a mesh has beside its positions came out of encoding.
namespace tvg {

/// Which of the two sides of a comparison have something.
enum class Presence : std::uint8_t { kBoth, kOriginalOnly, kDecodedOnly };

/// How far an attribute's values are off: in degrees for normals, else in the units that the values have.
struct AttributeDifference {
  std::string name;          ///< as the original has it, or the decoded side where it alone has it
  std::string decoded_name;  ///< another one only where no attribute of the kind has the same name
  AttributeKind kind = AttributeKind::kGeneric;
  AttributeDomain domain = AttributeDomain::kVertex;
  bool animated = false;
  Presence presence = Presence::kBoth;  ///< the figures below are 0 unless kBoth
  std::uint64_t values = 0;             ///< compared, over all frames of an animated attribute
  /// Of a component, or the angle between two normals; 180 where only one of them is (0, 0, 0). Infinite
  /// where a number that is not finite has become another one.
  double max_difference = 0;
  double rms_difference = 0;   ///< root mean square over components, or over angles
  double mean_difference = 0;  ///< of components' absolute differences, or of angles
};

/// How many of a kind both sides have, and how many differ.
struct CountDifference {
  std::uint64_t original = 0;
  std::uint64_t decoded = 0;
  std::uint64_t different = 0;

  bool present() const { return original > 0 || decoded > 0; }
  bool operator==(const CountDifference&) const = default;
};

struct PropertyReport {
  std::vector<AttributeDifference> attributes;  ///< the original's, then those of the decoded side alone
  CountDifference parts;                        ///< `different`: faces that are of another object or group
  CountDifference materials;          ///< names that parts have; `different`: faces that have another one
  CountDifference polygons;           ///< `different`: those that only one side has
  std::uint64_t unmatched_faces = 0;  ///< of either side, which the other does not have

  /// Whether there is anything to report.
  bool empty() const {
    return attributes.empty() && !parts.present() && !polygons.present() && unmatched_faces == 0;
  }
};

/// Compares what two meshes of the same vertices have beside their connectivity. Faces may come in another
/// order, and each with another corner first: a face is the one that has the same vertices in the same turn.
/// Attributes are matched by kind and name, what is left by kind alone, and compared at every vertex where
/// both are of vertices, else at every corner of the faces that both sides have. Components that one side
/// lacks count as 0, of a colour's alpha as 1.
class PropertyComparison {
 public:
  /// Both sides must stay until the last add_frame(), not until report(). kInvalidInput where properties do
  /// not fit their mesh, kInvalidArgument where the meshes have different numbers of vertices.
  static Result<PropertyComparison> of(const Mesh& original_mesh, const MeshProperties& original,
                                       const Mesh& decoded_mesh, const MeshProperties& decoded);
  ~PropertyComparison();
  PropertyComparison(PropertyComparison&&) noexcept;
  PropertyComparison& operator=(PropertyComparison&&) noexcept;

  /// Whether attributes are animated, so that their values come with frames.
  bool wants_frames() const;
  /// Takes the next frame: of each attribute of either side its values in this frame, [value][component],
  /// which are not looked at where it is not animated. kInvalidArgument where there are not as many as the
  /// mesh needs; such a frame is not counted.
  Status add_frame(std::span<const std::span<const float>> original,
                   std::span<const std::span<const float>> decoded);

  /// The figures so far.
  PropertyReport report() const;

 private:
  class State;
  explicit PropertyComparison(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The figures of several meshes that follow each other, as one: attributes of the same kind, name and
/// presence are one.
PropertyReport together(std::span<const PropertyReport> reports);

}  // namespace tvg
