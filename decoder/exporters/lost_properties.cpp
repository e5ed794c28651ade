#include "decoder/exporters/lost_properties.hpp"

#include "decoder/exporters/mesh_frame.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

/// How a format holds an attribute.
enum class Held { kNo, kPerVertex, kPerCorner };

struct Holds {
  Held texcoords;
  Held normals;
  Held colours;
  bool alpha;
  bool others;  ///< numbers by name, further texture coordinates and colours, per vertex
  bool parts;
  bool polygons;
};

Holds holds(HeldBy format) {
  switch (format) {
    case HeldBy::kObj:
      return {Held::kPerCorner, Held::kPerCorner, Held::kPerVertex, false, false, true, true};
    case HeldBy::kPly:
      return {Held::kPerCorner, Held::kPerVertex, Held::kPerVertex, true, true, false, true};
    case HeldBy::kOff:
      return {Held::kNo, Held::kNo, Held::kPerVertex, true, false, false, true};
    case HeldBy::kStl:
      return {Held::kNo, Held::kNo, Held::kNo, false, false, false, false};
    case HeldBy::kGltf:
      return {Held::kPerCorner, Held::kPerCorner, Held::kPerCorner, true, true, true, true};
  }
  return {};
}

class Judge {
 public:
  Judge(HeldBy format, const Mesh& mesh, const MeshProperties& properties)
      : format_(format), holds_(holds(format)), mesh_(mesh), properties_(properties) {}

  std::vector<std::string> judge() {
    const KnownAttributes known = known_attributes(properties_);
    judge_known(known.texcoord, holds_.texcoords, "texture coordinates");
    judge_known(known.normal, holds_.normals, "normals");
    judge_known(known.colour, holds_.colours, "colours");
    if (known.colour && holds_.colours != Held::kNo && !holds_.alpha &&
        properties_.attributes[*known.colour].components == 4) {
      lost_.emplace_back("alpha of colours");
    }
    for (const std::size_t other : known.others) judge_other(properties_.attributes[other]);
    if (!holds_.parts && has_parts()) lost_.emplace_back("objects, groups and materials");
    if (!holds_.polygons && !properties_.polygons.empty())
      lost_.emplace_back("polygons (they are triangles)");
    return std::move(lost_);
  }

 private:
  bool has_parts() const {
    return std::any_of(properties_.parts.begin(), properties_.parts.end(), [](const Part& part) {
      return !part.object.empty() || !part.group.empty() || !part.material.empty();
    });
  }

  void judge_known(const std::optional<std::size_t>& index, Held held, const std::string& what) {
    if (!index) return;
    const Attribute& attribute = properties_.attributes[*index];
    if (held == Held::kNo) {
      lost_.push_back(what);
    } else if (held == Held::kPerVertex && !vertex_values(mesh_, attribute)) {
      lost_.push_back(what + " that differ between the corners of a vertex");
    } else if (format_ == HeldBy::kGltf && attribute.animated && attribute.kind != AttributeKind::kNormal) {
      lost_.push_back(fmt::format("how {} change over time (they stay as they are first)", what));
    }
  }

  void judge_other(const Attribute& attribute) {
    static constexpr std::array<const char*, 4> kKinds = {"texture coordinates", "normals", "colours",
                                                          "numbers"};
    const std::string what = attribute.name.empty()
                                 ? fmt::format("further {}", kKinds[static_cast<std::size_t>(attribute.kind)])
                                 : fmt::format("\"{}\"", one_line(attribute.name));
    const bool held_by_gltf = format_ == HeldBy::kGltf && attribute.domain != AttributeDomain::kVertex;
    if (!holds_.others || (!held_by_gltf && !vertex_values(mesh_, attribute))) {
      lost_.push_back(what);
    } else if (format_ == HeldBy::kGltf && attribute.animated) {
      lost_.push_back(fmt::format("how {} changes over time (it stays as it is first)", what));
    }
  }

  HeldBy format_;
  Holds holds_;
  const Mesh& mesh_;
  const MeshProperties& properties_;
  std::vector<std::string> lost_;
};

}  // namespace

std::vector<std::string> lost_in(HeldBy format, const Mesh& mesh, const MeshProperties& properties) {
  return Judge(format, mesh, properties).judge();
}

void LossNotes::add(HeldBy format, const Mesh& mesh, const MeshProperties& properties) {
  for (const std::string& words : lost_in(format, mesh, properties)) add(words);
}

void LossNotes::add(const std::string& words) {
  if (std::find(lost_.begin(), lost_.end(), words) == lost_.end()) lost_.push_back(words);
}

std::vector<std::string> LossNotes::notes(const std::string& format) const {
  if (lost_.empty()) return {};
  std::string words = lost_[0];
  for (std::size_t i = 1; i < lost_.size(); ++i) words += (i + 1 < lost_.size() ? ", " : " and ") + lost_[i];
  return {fmt::format("{} has no place for {}: left out", format, words)};
}

}  // namespace tvg::cli
