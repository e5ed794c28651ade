#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// What a mesh has beside its connectivity: attributes, parts, polygons, and free-form data that go with it.
namespace tvg {

/// What the numbers of an attribute mean, and so how they are coded. The numbers are those of the format.
enum class AttributeKind : std::uint8_t {
  kTexcoord = 0,  ///< one to four numbers; v points up, as in OBJ
  kNormal = 1,    ///< three numbers of length 1, or (0, 0, 0) for none
  kColour = 2,    ///< three or four numbers from 0 to 1, red, green, blue and alpha, as the source has them
  kGeneric = 3,   ///< one to four numbers that mean what the name says
};

/// What has a value each. The numbers are those of the format.
enum class AttributeDomain : std::uint8_t {
  kVertex = 0,
  kCorner = 1,  ///< of a face: values that the faces around a vertex share are stored once
  kPart = 2,
};

inline constexpr std::uint32_t kMaxAttributeComponents = 4;
inline constexpr std::uint32_t kMaxAttributes = 64;
/// Of texture coordinates, colours and generic numbers, and of each of the two numbers of a normal.
inline constexpr int kMaxAttributeBits = 24;
inline constexpr int kMaxNormalBits = 16;

/// Numbers that a mesh has for each of its vertices, corners or parts.
struct Attribute {
  static constexpr int kBitsOfKind = -1;  ///< what the encoder's options say for the kind
  static constexpr int kExact = 0;        ///< float32, of which every bit comes back

  std::string name;  ///< as is_metadata_text(); may be empty, and need not be unique
  AttributeKind kind = AttributeKind::kGeneric;
  AttributeDomain domain = AttributeDomain::kVertex;
  std::uint32_t components = 1;  ///< 1 to kMaxAttributeComponents
  /// How fine the values are: kExact, or so many bits for each component (for a normal: for each of its two
  /// octahedral coordinates). Values then lie on the 2^bits points of a grid that begins and ends with the
  /// smallest and the largest value (from 0 to 1 where all colours lie within), so that none is off by more
  /// than half a step.
  int bits = kBitsOfKind;
  /// The values are those of one frame, and each frame has its own: for an encoder those that come with
  /// frames, and these here are not looked at.
  bool animated = false;
  std::vector<float> values;  ///< [value][component]; value i is of vertex or part i where `corners` is empty
  std::vector<std::uint32_t> corners;  ///< kCorner: [face][corner], which value it has; empty for others

  std::size_t value_count() const { return components == 0 ? 0 : values.size() / components; }
  bool operator==(const Attribute&) const = default;
};

/// Some of a mesh's faces: those of one object, group and material.
struct Part {
  std::string object;
  std::string group;
  std::string material;  ///< one of those that the stream's data describe ("materials"), or none
  bool operator==(const Part&) const = default;
};

/// A face of more than three corners, which became a fan of triangles around its first corner.
struct Polygon {
  std::size_t first_triangle = 0;
  std::uint32_t corners = 0;

  bool operator==(const Polygon&) const = default;
};

/// All that a mesh has beside its connectivity. Empty for a mesh of which only positions matter.
struct MeshProperties {
  std::vector<Attribute> attributes;
  std::vector<Part> parts;
  std::vector<std::uint32_t> face_parts;  ///< [face], its part; empty where there are no parts
  std::vector<Polygon> polygons;          ///< in the order of their triangles

  bool empty() const { return attributes.empty() && parts.empty() && polygons.empty(); }
  bool operator==(const MeshProperties&) const = default;
};

/// Free-form data that go with a stream under a name (format-spec §4.8). These names have a meaning:
/// - "materials": a JSON object with the arrays `materials`, `textures`, `images` and `samplers` of glTF 2.0.
///   Materials have unique names, which parts refer to. An image has a `uri`, as the source had it, or
///   `extras.data`, the name of the data that are the image's file. What glTF has no word for is in `extras`;
///   a material that comes from an MTL file has its lines there as `extras.mtl`.
/// - "image/NAME": an image file.
/// - "extras": JSON, `extras` of a glTF's scene, nodes and meshes.
/// - "skeleton": JSON, `joints` with `name` and `parent` (an index, or -1); "skeleton/positions": float32,
///   least significant byte first, [frame][joint][xyz].
/// - "times": float64, least significant byte first: when each of the stream's frames is, in seconds, where
///   frames do not follow each other at an even rate.
/// - "tvg/part": which part of a whole that was encoded in parts the stream is (tvg/parts.hpp).
struct NamedData {
  std::string name;  ///< 1 to 1024 bytes, as is_metadata_text()
  std::vector<std::uint8_t> bytes;

  bool operator==(const NamedData&) const = default;
};

}  // namespace tvg
