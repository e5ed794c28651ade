#include "base/errors.hpp"
#include "geometry/property_fault.hpp"
#include "metrics/attribute_difference.hpp"
#include "metrics/face_match.hpp"
#include "metrics/polygon_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include <tvg/property_metrics.hpp>

namespace tvg {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Side {
  const Mesh& mesh;
  const MeshProperties& properties;

  const Part* part_of(std::uint32_t face) const {
    return properties.parts.empty() ? nullptr : &properties.parts[properties.face_parts[face]];
  }
};

/// An attribute of a side, with its values at present.
struct SidedAttribute {
  const Side& side;
  const Attribute& attribute;
  std::span<const float> values;

  std::span<const float> value(std::size_t index) const {
    return values.subspan(index * attribute.components, attribute.components);
  }
  std::span<const float> at_corner(std::uint32_t face, std::uint32_t corner) const {
    switch (attribute.domain) {
      case AttributeDomain::kVertex:
        return value(side.mesh.faces[face][corner]);
      case AttributeDomain::kPart:
        return value(side.properties.face_parts[face]);
      default:
        return value(attribute.corners[3 * std::size_t{face} + corner]);
    }
  }
  /// Whether every value that the mesh refers to is there.
  bool complete() const {
    std::size_t needed =
        attribute.domain == AttributeDomain::kPart ? side.properties.parts.size() : side.mesh.vertex_count;
    if (attribute.domain == AttributeDomain::kCorner) {
      needed = 0;
      for (const std::uint32_t corner : attribute.corners) needed = std::max(needed, std::size_t{corner} + 1);
    }
    return values.size() / attribute.components >= needed;
  }
};

/// Attributes of both sides that are compared with each other, by their places.
struct AttributePair {
  std::size_t original = kNone;
  std::size_t decoded = kNone;
};

std::vector<AttributePair> pair_attributes(const std::vector<Attribute>& original,
                                           const std::vector<Attribute>& decoded) {
  std::vector<AttributePair> pairs(original.size());
  std::vector<bool> taken(decoded.size(), false);
  for (const bool by_name : {true, false}) {
    for (std::size_t i = 0; i < original.size(); ++i) {
      pairs[i].original = i;
      for (std::size_t j = 0; j < decoded.size() && pairs[i].decoded == kNone; ++j) {
        if (taken[j] || decoded[j].kind != original[i].kind) continue;
        if (by_name && decoded[j].name != original[i].name) continue;
        pairs[i].decoded = j;
        taken[j] = true;
      }
    }
  }
  for (std::size_t j = 0; j < decoded.size(); ++j) {
    if (!taken[j]) pairs.push_back({kNone, j});
  }
  return pairs;
}

std::uint64_t material_count(const MeshProperties& properties) {
  std::set<std::string> names;
  for (const Part& part : properties.parts) {
    if (!part.material.empty()) names.insert(part.material);
  }
  return names.size();
}

/// Why polygons are none of the mesh's, or null.
const char* polygon_fault(const Side& side) {
  const std::size_t faces = side.mesh.faces.size();
  for (const Polygon& polygon : side.properties.polygons) {
    if (polygon.corners < 3 || polygon.first_triangle >= faces ||
        polygon.corners - 2 > faces - polygon.first_triangle)
      return "a polygon lies outside the faces of the mesh";
  }
  return nullptr;
}

}  // namespace

class PropertyComparison::State {
 public:
  State(const Side& original, const Side& decoded)
      : original_(original),
        decoded_(decoded),
        match_(match_faces(original.mesh.faces, decoded.mesh.faces)),
        pairs_(pair_attributes(original.properties.attributes, decoded.properties.attributes)) {
    for (const AttributePair& pair : pairs_) {
      report_.attributes.push_back(describe(pair));
      sums_.emplace_back(report_.attributes.back().kind);
    }
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (in_both(pairs_[i]) && !animated(pairs_[i]))
        compare(
            sides_of(pairs_[i], original_attribute(pairs_[i]).values, decoded_attribute(pairs_[i]).values),
            sums_[i]);
    }
    compare_parts();
    report_.polygons = {original.properties.polygons.size(), decoded.properties.polygons.size(),
                        unmatched_polygons(original.mesh.faces, original.properties.polygons,
                                           decoded.mesh.faces, decoded.properties.polygons)};
    report_.unmatched_faces = match_.unmatched;
  }

  bool wants_frames() const {
    return std::any_of(pairs_.begin(), pairs_.end(),
                       [this](const AttributePair& pair) { return in_both(pair) && animated(pair); });
  }

  Status add_frame(std::span<const std::span<const float>> original,
                   std::span<const std::span<const float>> decoded) {
    if (original.size() < original_.properties.attributes.size() ||
        decoded.size() < decoded_.properties.attributes.size())
      return invalid_argument("a frame has values for each attribute of its mesh");
    std::vector<std::pair<SidedPair, DifferenceSum*>> wanted;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const AttributePair& pair = pairs_[i];
      if (!in_both(pair) || !animated(pair)) continue;
      const Attribute& a = original_attribute(pair);
      const Attribute& b = decoded_attribute(pair);
      const SidedPair sides = sides_of(pair, a.animated ? original[pair.original] : std::span(a.values),
                                       b.animated ? decoded[pair.decoded] : std::span(b.values));
      if (!sides.first.complete() || !sides.second.complete())
        return invalid_argument("a frame has fewer values of an attribute than the mesh refers to");
      wanted.emplace_back(sides, &sums_[i]);
    }
    for (const auto& [sides, sum] : wanted) compare(sides, *sum);
    return {};
  }

  PropertyReport report() const {
    PropertyReport report = report_;
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].give(report.attributes[i]);
    return report;
  }

 private:
  using SidedPair = std::pair<SidedAttribute, SidedAttribute>;

  static bool in_both(const AttributePair& pair) { return pair.original != kNone && pair.decoded != kNone; }
  const Attribute& original_attribute(const AttributePair& pair) const {
    return original_.properties.attributes[pair.original];
  }
  const Attribute& decoded_attribute(const AttributePair& pair) const {
    return decoded_.properties.attributes[pair.decoded];
  }
  AttributeDifference describe(const AttributePair& pair) const {
    const Attribute& attribute = pair.original != kNone ? original_attribute(pair) : decoded_attribute(pair);
    AttributeDifference difference;
    difference.name = attribute.name;
    difference.decoded_name = pair.decoded != kNone ? decoded_attribute(pair).name : attribute.name;
    difference.kind = attribute.kind;
    difference.domain = attribute.domain;
    difference.animated = in_both(pair) ? animated(pair) : attribute.animated;
    if (!in_both(pair))
      difference.presence = pair.decoded == kNone ? Presence::kOriginalOnly : Presence::kDecodedOnly;
    return difference;
  }
  bool animated(const AttributePair& pair) const {
    return original_attribute(pair).animated || decoded_attribute(pair).animated;
  }
  SidedPair sides_of(const AttributePair& pair, std::span<const float> original,
                     std::span<const float> decoded) const {
    return {{original_, original_attribute(pair), original}, {decoded_, decoded_attribute(pair), decoded}};
  }

  void compare(const SidedPair& sides, DifferenceSum& sum) const {
    const auto& [a, b] = sides;
    if (a.attribute.domain == AttributeDomain::kVertex && b.attribute.domain == AttributeDomain::kVertex) {
      for (std::size_t v = 0; v < original_.mesh.vertex_count; ++v) sum.add(a.value(v), b.value(v));
      return;
    }
    for (const FaceMatch::Pair& face : match_.pairs) {
      for (std::uint32_t corner = 0; corner < 3; ++corner)
        sum.add(a.at_corner(face.original, corner), b.at_corner(face.decoded, (corner + face.turn) % 3));
    }
  }

  void compare_parts() {
    report_.parts = {original_.properties.parts.size(), decoded_.properties.parts.size(), 0};
    report_.materials = {material_count(original_.properties), material_count(decoded_.properties), 0};
    const Part none;
    for (const FaceMatch::Pair& face : match_.pairs) {
      const Part* const a = original_.part_of(face.original);
      const Part* const b = decoded_.part_of(face.decoded);
      const Part& in_original = a != nullptr ? *a : none;
      const Part& in_decoded = b != nullptr ? *b : none;
      if (in_original.object != in_decoded.object || in_original.group != in_decoded.group)
        ++report_.parts.different;
      if (in_original.material != in_decoded.material) ++report_.materials.different;
    }
  }

  const Side original_, decoded_;
  FaceMatch match_;
  std::vector<AttributePair> pairs_;
  std::vector<DifferenceSum> sums_;  ///< [pair]
  PropertyReport report_;            ///< without the sums
};

PropertyComparison::PropertyComparison(std::unique_ptr<State> state) : state_(std::move(state)) {}
PropertyComparison::~PropertyComparison() = default;
PropertyComparison::PropertyComparison(PropertyComparison&&) noexcept = default;
PropertyComparison& PropertyComparison::operator=(PropertyComparison&&) noexcept = default;

Result<PropertyComparison> PropertyComparison::of(const Mesh& original_mesh, const MeshProperties& original,
                                                  const Mesh& decoded_mesh, const MeshProperties& decoded) {
  if (original_mesh.vertex_count != decoded_mesh.vertex_count)
    return invalid_argument("only properties of meshes with the same vertices can be compared");
  const Side a{original_mesh, original}, b{decoded_mesh, decoded};
  for (const Side* side : {&a, &b}) {
    const char* fault = property_fault(side->mesh, side->properties);
    if (fault == nullptr) fault = polygon_fault(*side);
    if (fault != nullptr) return invalid_input(fault);
  }
  return PropertyComparison(std::make_unique<State>(a, b));
}

bool PropertyComparison::wants_frames() const {
  return state_->wants_frames();
}

Status PropertyComparison::add_frame(std::span<const std::span<const float>> original,
                                     std::span<const std::span<const float>> decoded) {
  return state_->add_frame(original, decoded);
}

PropertyReport PropertyComparison::report() const {
  return state_->report();
}

namespace {

void add(CountDifference& all, const CountDifference& one) {
  all.original = std::max(all.original, one.original);
  all.decoded = std::max(all.decoded, one.decoded);
  all.different += one.different;
}

void add(AttributeDifference& all, const AttributeDifference& one) {
  const double before = static_cast<double>(all.values), more = static_cast<double>(one.values);
  if (one.values == 0) return;
  const double total = before + more;
  all.max_difference = std::max(all.max_difference, one.max_difference);
  all.rms_difference = std::sqrt(
      (before * all.rms_difference * all.rms_difference + more * one.rms_difference * one.rms_difference) /
      total);
  all.mean_difference = (before * all.mean_difference + more * one.mean_difference) / total;
  all.values += one.values;
  all.animated = all.animated || one.animated;
}

}  // namespace

PropertyReport together(std::span<const PropertyReport> reports) {
  PropertyReport all;
  for (const PropertyReport& report : reports) {
    std::vector<bool> taken(all.attributes.size(), false);
    for (const AttributeDifference& attribute : report.attributes) {
      std::size_t place = 0;
      while (place < taken.size() && (taken[place] || all.attributes[place].kind != attribute.kind ||
                                      all.attributes[place].name != attribute.name ||
                                      all.attributes[place].presence != attribute.presence)) {
        ++place;
      }
      if (place == taken.size()) {
        all.attributes.push_back(attribute);
      } else {
        taken[place] = true;
        add(all.attributes[place], attribute);
      }
    }
    add(all.parts, report.parts);
    add(all.materials, report.materials);
    add(all.polygons, report.polygons);
    all.unmatched_faces += report.unmatched_faces;
  }
  return all;
}

}  // namespace tvg
