#pragma once
#include <cstddef>
#include <cstdint>

#include <tvg/properties.hpp>

// What the properties of a mesh count for against the bound that the head declares (format-spec §5.7).
namespace tvg {

/// Counts of what attributes can belong to.
struct PropertyCounts {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t parts = 0;
};

/// Of an attribute that is not animated.
constexpr std::uint64_t attribute_bytes(const PropertyCounts& counts, AttributeDomain domain,
                                        std::uint64_t components, std::uint64_t name_bytes) {
  const std::uint64_t head = 256 + name_bytes;
  if (domain == AttributeDomain::kVertex) return head + 4 * components * counts.vertices;
  if (domain == AttributeDomain::kPart) return head + 4 * components * counts.parts;
  return head + 12 * counts.faces * (1 + components);
}

/// Of one that is: frames before and what is learnt of them take room.
constexpr std::uint64_t animated_bytes(const PropertyCounts& counts, AttributeDomain domain,
                                       std::uint64_t components, std::uint64_t name_bytes) {
  return (std::uint64_t{1} << 15) + 48 * counts.faces +
         5 * attribute_bytes(counts, domain, components, name_bytes);
}

/// Of a part and the texts that name it.
constexpr std::uint64_t part_bytes(std::uint64_t text_bytes) {
  return 192 + text_bytes;
}
/// Of a face where there are parts.
inline constexpr std::uint64_t kFacePartBytes = 4;
inline constexpr std::uint64_t kPolygonBytes = 16;

inline std::uint64_t property_bytes(const MeshProperties& properties, std::uint64_t vertices,
                                    std::uint64_t faces) {
  std::uint64_t bytes = kPolygonBytes * properties.polygons.size();
  for (const Part& part : properties.parts)
    bytes += part_bytes(part.object.size() + part.group.size() + part.material.size());
  if (!properties.parts.empty()) bytes += kFacePartBytes * faces;
  for (const Attribute& attribute : properties.attributes) {
    const auto of_one = attribute.animated ? animated_bytes : attribute_bytes;
    bytes += of_one({vertices, faces, properties.parts.size()}, attribute.domain, attribute.components,
                    attribute.name.size());
  }
  return bytes;
}

/// What the values of animated attributes may take of a frame's packet: more than the worst residual can take
/// for each number, and what is before them.
inline std::uint64_t animated_frame_bytes(const MeshProperties& properties, std::uint64_t vertices,
                                          std::uint64_t faces) {
  constexpr std::uint64_t kPerNumber = 10, kPerPiece = 64;
  std::uint64_t bytes = 0;
  for (const Attribute& attribute : properties.attributes) {
    if (!attribute.animated) continue;
    const std::uint64_t values = attribute.domain == AttributeDomain::kVertex   ? vertices
                                 : attribute.domain == AttributeDomain::kCorner ? 3 * faces
                                                                                : properties.parts.size();
    bytes += kPerPiece + kPerNumber * attribute.components * values;
  }
  return bytes;
}

/// What is left of the bound that a stream declares while the properties of a mesh are decoded.
class PropertyBudget {
 public:
  explicit PropertyBudget(std::uint64_t bound) : left_(bound) {}

  /// False where there is not as much left.
  [[nodiscard]] bool take(std::uint64_t bytes) {
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }

 private:
  std::uint64_t left_;
};

}  // namespace tvg
