#include "encoder/importers/scene_mesh.hpp"

#include "encoder/importers/scene_attributes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <tvg/geometry.hpp>

namespace tvg::cli {

namespace {

/// The same for equal values: both zeros are one.
std::uint64_t mix_value(std::uint64_t hash, double value) {
  return mix_hash(hash, std::bit_cast<std::uint64_t>(value + 0.0));
}

std::uint64_t hash_of(const SceneMesh& mesh, std::size_t vertex) {
  std::uint64_t hash = 0;
  for (const double value : mesh.positions[vertex]) hash = mix_value(hash, value);
  for (const Influence& influence : mesh.influences_of(vertex)) {
    hash = mix_value(mix_hash(hash, influence.carrier), influence.weight);
  }
  for (const MorphDelta& morph : mesh.morphs_of(vertex)) {
    hash = mix_hash(hash, morph.slot);
    for (const double value : morph.delta) hash = mix_value(hash, value);
  }
  return hash;
}

bool are_equal(const SceneMesh& mesh, std::size_t a, std::size_t b) {
  return mesh.positions[a] == mesh.positions[b] &&
         std::ranges::equal(mesh.influences_of(a), mesh.influences_of(b),
                            [](const Influence& x, const Influence& y) {
                              return x.carrier == y.carrier && x.weight == y.weight;
                            }) &&
         std::ranges::equal(
             mesh.morphs_of(a), mesh.morphs_of(b),
             [](const MorphDelta& x, const MorphDelta& y) { return x.slot == y.slot && x.delta == y.delta; });
}

}  // namespace

std::span<const Influence> SceneMesh::influences_of(std::size_t vertex) const {
  return std::span(influences)
      .subspan(influence_begin[vertex], influence_begin[vertex + 1] - influence_begin[vertex]);
}

std::span<const MorphDelta> SceneMesh::morphs_of(std::size_t vertex) const {
  return std::span(morphs).subspan(morph_begin[vertex], morph_begin[vertex + 1] - morph_begin[vertex]);
}

void SceneMesh::pose(const std::vector<Transform>& global, const std::vector<double>& weights,
                     std::vector<Transform>& scratch, std::span<float> out) const {
  scratch.clear();
  for (const Carrier& carrier : carriers) scratch.push_back(global[carrier.node] * carrier.offset);
  for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
    Eigen::Vector3d base = positions[vertex];
    for (const MorphDelta& morph : morphs_of(vertex)) base += weights[morph.slot] * morph.delta;
    Eigen::Vector3d placed = Eigen::Vector3d::Zero();
    for (const Influence& influence : influences_of(vertex)) {
      placed += influence.weight * (scratch[influence.carrier] * base);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out[3 * vertex + axis] = static_cast<float>(placed[static_cast<Eigen::Index>(axis)]);
    }
  }
}

void place_normals(SceneMesh& mesh, const std::vector<Transform>& global) {
  std::vector<Eigen::Matrix3d> linear;
  for (const Carrier& carrier : mesh.carriers)
    linear.emplace_back((global[carrier.node] * carrier.offset).linear());
  for (Attribute& attribute : mesh.properties.attributes) {
    if (attribute.kind != AttributeKind::kNormal) continue;
    for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
      Eigen::Matrix3d blended = Eigen::Matrix3d::Zero();
      for (const Influence& influence : mesh.influences_of(vertex))
        blended += influence.weight * linear[influence.carrier];
      // What is across the images of two edges is across their images under the cofactors.
      Eigen::Matrix3d cofactors;
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        cofactors.col(axis) = blended.col((axis + 1) % 3).cross(blended.col((axis + 2) % 3));
      if (blended.determinant() < 0) cofactors = -cofactors;
      Eigen::Map<Eigen::Vector3f> normal(&attribute.values[3 * vertex]);
      const Eigen::Vector3d placed = cofactors * normal.cast<double>();
      const double length = placed.norm();
      if (std::isfinite(length) && length > 0) {
        normal = (placed / length).cast<float>();
      } else {
        normal.setZero();
      }
    }
  }
}

void weld(SceneMesh& mesh) {
  const Weld found = weld_points(
      mesh.positions.size(), [&mesh](std::size_t vertex) { return hash_of(mesh, vertex); },
      [&mesh](std::size_t a, std::size_t b) { return are_equal(mesh, a, b); });
  SceneMesh welded;
  welded.influence_begin = {0};
  welded.morph_begin = {0};
  for (const std::uint32_t vertex : found.first_point) {
    welded.positions.push_back(mesh.positions[vertex]);
    for (const Influence& influence : mesh.influences_of(vertex)) welded.influences.push_back(influence);
    for (const MorphDelta& morph : mesh.morphs_of(vertex)) welded.morphs.push_back(morph);
    welded.influence_begin.push_back(welded.influences.size());
    welded.morph_begin.push_back(welded.morphs.size());
  }
  for (Attribute& attribute : mesh.properties.attributes) {
    if (attribute.domain == AttributeDomain::kPart) continue;
    attribute = with_joined_vertices(attribute, mesh.mesh.faces, found.vertex_of_point, found.vertex_count());
  }
  for (Face& face : mesh.mesh.faces) {
    for (std::uint32_t& index : face) index = found.vertex_of_point[index];
  }
  mesh.mesh.vertex_count = found.vertex_count();
  mesh.positions = std::move(welded.positions);
  mesh.influences = std::move(welded.influences);
  mesh.influence_begin = std::move(welded.influence_begin);
  mesh.morphs = std::move(welded.morphs);
  mesh.morph_begin = std::move(welded.morph_begin);
}

}  // namespace tvg::cli
