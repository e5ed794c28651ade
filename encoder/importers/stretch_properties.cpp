#include "encoder/importers/stretch_properties.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace tvg::cli {

namespace {

/// The value of an attribute at a corner of a vertex.
const float* value_at(const Attribute& attribute, std::size_t corner, std::uint32_t vertex) {
  const std::size_t value = attribute.corners.empty() ? vertex : attribute.corners[corner];
  return attribute.values.data() + value * attribute.components;
}

bool same_kind(const Attribute& a, const Attribute& b) {
  return a.kind == b.kind && a.components == b.components && a.name == b.name;
}

bool is_of_parts(const Attribute& attribute) {
  return attribute.domain == AttributeDomain::kPart;
}

std::size_t count_of_faces(const std::vector<Attribute>& attributes) {
  return attributes.size() -
         static_cast<std::size_t>(std::count_if(attributes.begin(), attributes.end(), is_of_parts));
}

/// Whether every corner has the same value in both; `match` leads from the corners of `a` to those of `b`.
bool same_values(const Attribute& a, const Attribute& b, std::span<const Face> faces,
                 const CornerMatch& match) {
  if (a.corners.empty() && b.corners.empty()) return a.values == b.values;
  if (match.all_in_place() && a.corners == b.corners && a.values == b.values) return true;
  for (std::size_t corner = 0; corner < 3 * faces.size(); ++corner) {
    const std::uint32_t vertex = faces[corner / 3][corner % 3];
    const float* const value = value_at(a, corner, vertex);
    if (!std::equal(value, value + a.components, value_at(b, match[corner], vertex))) return false;
  }
  return true;
}

std::string name_of(const Attribute& attribute) {
  switch (attribute.kind) {
    case AttributeKind::kTexcoord:
      return "texture coordinates";
    case AttributeKind::kNormal:
      return "normals";
    case AttributeKind::kColour:
      return "colours";
    case AttributeKind::kGeneric:
      break;
  }
  return "values of '" + attribute.name + "'";
}

}  // namespace

StretchProperties::StretchProperties(const MeshFile& first, const PropertyOptions& options)
    : options_(options) {
  if (!options.wanted) return;
  properties_ = {first.attributes, first.parts, first.face_parts, first.polygons};
  file_attributes_ = count_of_faces(properties_.attributes);
  tracks_.resize(properties_.attributes.size());
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Attribute& attribute = properties_.attributes[i];
    for (std::size_t before = 0; before < i; ++before)
      tracks_[i].occurrence += same_kind(properties_.attributes[before], attribute) ? 1 : 0;
    if (attribute.kind == AttributeKind::kNormal && options.normals == NormalsChoice::kAuto)
      tracks_[i].shading = find_shading(first.faces, first.polygons, first.positions, attribute);
  }
  for (std::size_t i = tracks_.size(); i-- > 0 && options.normals == NormalsChoice::kDrop;) {
    if (properties_.attributes[i].kind == AttributeKind::kNormal) drop(i);
  }
}

const Attribute* StretchProperties::find(const MeshFile& file, std::size_t attribute) const {
  std::size_t left = tracks_[attribute].occurrence;
  for (const Attribute& candidate : file.attributes) {
    if (same_kind(candidate, properties_.attributes[attribute]) && left-- == 0) return &candidate;
  }
  return nullptr;
}

void StretchProperties::look_at(const MeshFile& other, std::span<const Face> faces) {
  const CornerMatch match(faces, other.faces);
  if (!match.found()) return;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Attribute& first = properties_.attributes[i];
    const Attribute* const values = find(other, i);
    if (is_of_parts(first) || values == nullptr) continue;
    Track& track = tracks_[i];
    if (track.shading && find_shading(other.faces, other.polygons, other.positions, *values) != track.shading)
      track.shading.reset();
    if (!track.changes && same_values(first, *values, faces, match)) continue;
    if (!std::exchange(track.changes, true)) refine(track, first, faces, CornerMatch(faces, faces));
    refine(track, *values, faces, match);
  }
}

/// Parts the corners that agreed so far where they do not in `values`.
void StretchProperties::refine(Track& track, const Attribute& values, std::span<const Face> faces,
                               const CornerMatch& match) const {
  if (values.corners.empty()) return;
  const auto vertex_of = [&](std::size_t corner) { return faces[corner / 3][corner % 3]; };
  const auto class_of = [&](std::size_t corner) {
    return track.classes.empty() ? vertex_of(corner) : track.classes[corner];
  };
  const auto value_of = [&](std::size_t corner) {
    return value_at(values, match[corner], vertex_of(corner));
  };
  const auto hash = [&](std::uint32_t corner) {
    std::uint64_t mixed = mix_hash(0, class_of(corner));
    for (std::uint32_t i = 0; i < values.components; ++i)
      mixed = mix_hash(mixed, std::bit_cast<std::uint32_t>(value_of(corner)[i] + 0.0F));
    return mixed;
  };
  const auto equal = [&](std::uint32_t a, std::uint32_t b) {
    return class_of(a) == class_of(b) &&
           std::equal(value_of(a), value_of(a) + values.components, value_of(b));
  };
  Weld weld = weld_points(3 * faces.size(), hash, equal);
  track.class_count = weld.vertex_count();
  track.classes = std::move(weld.vertex_of_point);
}

/// Why normals need not be kept; empty where they do.
std::string StretchProperties::why_dropped(std::size_t attribute, bool still) const {
  if (properties_.attributes[attribute].kind != AttributeKind::kNormal ||
      options_.normals != NormalsChoice::kAuto)
    return "";
  if (tracks_[attribute].shading == NormalShading::kSmooth)
    return "its normals are left out: they are what the faces give, shaded smoothly";
  if (tracks_[attribute].shading == NormalShading::kFlat)
    return "its normals are left out: they are those of the faces, shaded flat";
  if (still) return "its normals are left out: they are those of its own pose, and the frames have others";
  return "";
}

void StretchProperties::drop(std::size_t attribute) {
  flat_ = flat_ || tracks_[attribute].shading == NormalShading::kFlat;
  properties_.attributes.erase(properties_.attributes.begin() + static_cast<std::ptrdiff_t>(attribute));
  tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(attribute));
}

void StretchProperties::settle(std::span<const Face> faces, bool still, std::vector<std::string>& notes) {
  for (std::size_t i = tracks_.size(); i-- > 0;) {
    const std::string why = why_dropped(i, still);
    if (why.empty()) continue;
    notes.push_back(why + " (--normals keep keeps them)");
    drop(i);
  }
  std::vector<std::string> changing;
  const CornerMatch in_place(faces, faces);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].changes) continue;
    Attribute& attribute = properties_.attributes[i];
    const Attribute first = std::move(attribute);
    attribute = {first.name, first.kind, AttributeDomain::kVertex, first.components, first.bits, true,
                 {},         {}};
    const std::size_t vertices = first.corners.empty() ? first.value_count() : 0;
    attribute.values.resize(vertices * first.components);
    if (!tracks_[i].classes.empty()) {
      attribute.domain = AttributeDomain::kCorner;
      attribute.corners = std::move(tracks_[i].classes);
      attribute.values.resize(std::size_t{tracks_[i].class_count} * first.components);
    }
    take(i, first, faces, in_place);
    changing.push_back(name_of(attribute));
  }
  if (!changing.empty())
    notes.push_back(fmt::format("its {} change from frame to frame", fmt::join(changing, ", ")));
}

/// Takes the values of a frame for those of an animated attribute. False where corners that share one have
/// different ones in this frame: the first is taken then.
bool StretchProperties::take(std::size_t attribute, const Attribute& values, std::span<const Face> faces,
                             const CornerMatch& match) {
  Attribute& animated = properties_.attributes[attribute];
  if (animated.corners.empty() && values.corners.empty()) {
    animated.values = values.values;
    return true;
  }
  bool agree = true;
  const std::size_t components = animated.components;
  std::vector<bool> taken(animated.value_count(), false);
  for (std::size_t corner = 0; corner < 3 * faces.size(); ++corner) {
    const std::uint32_t vertex = faces[corner / 3][corner % 3];
    const std::size_t value = animated.corners.empty() ? vertex : animated.corners[corner];
    const float* const given = value_at(values, match[corner], vertex);
    float* const kept = animated.values.data() + value * components;
    if (taken[value]) {
      agree = agree && std::equal(given, given + components, kept);
    } else {
      std::copy_n(given, components, kept);
      taken[value] = true;
    }
  }
  return agree;
}

std::string StretchProperties::read(const MeshFile& file, std::span<const Face> faces, std::string& note) {
  if (tracks_.empty()) return "";
  if (count_of_faces(file.attributes) != file_attributes_) return "attributes";
  const CornerMatch match(faces, file.faces);
  if (!match.found()) {
    note =
        "its polygons begin with other corners: its attributes cannot be matched and are those of the frame "
        "before";
    return "";
  }
  if (file.parts != properties_.parts || (match.all_in_place() && file.face_parts != properties_.face_parts))
    note = "its objects, groups and materials are not those of the first file, which hold";
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Attribute& attribute = properties_.attributes[i];
    if (is_of_parts(attribute)) continue;
    const Attribute* const values = find(file, i);
    if (values == nullptr) return name_of(attribute);
    if (!attribute.animated) {
      if (!same_values(attribute, *values, faces, match)) return name_of(attribute);
    } else if (!take(i, *values, faces, match)) {
      if (attribute.kind != AttributeKind::kNormal) return name_of(attribute);
      note = "its normals have edges where the files that were looked at have none: they are smooth there";
    }
  }
  return "";
}

}  // namespace tvg::cli
