#include "encoder/importers/scene_mesh.hpp"

#include <cstring>
#include <unordered_map>

namespace tvg::cli {

namespace {

/// Bits that are equal where values are: both zeros are one.
void append_bits(std::string& key, double value) {
  const double unsigned_zero = value == 0 ? 0.0 : value;
  char bytes[sizeof(double)];
  std::memcpy(bytes, &unsigned_zero, sizeof bytes);
  key.append(bytes, sizeof bytes);
}

void append_bits(std::string& key, std::uint32_t value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof bytes);
  key.append(bytes, sizeof bytes);
}

void make_key(const SceneMesh& mesh, std::size_t vertex, std::string& key) {
  key.clear();
  for (const double value : mesh.positions[vertex]) append_bits(key, value);
  const auto influences = mesh.influences_of(vertex);
  append_bits(key, static_cast<std::uint32_t>(influences.size()));
  for (const Influence& influence : influences) {
    append_bits(key, influence.carrier);
    append_bits(key, influence.weight);
  }
  for (const MorphDelta& morph : mesh.morphs_of(vertex)) {
    append_bits(key, morph.slot);
    for (const double value : morph.delta) append_bits(key, value);
  }
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

void weld(SceneMesh& mesh) {
  std::unordered_map<std::string, std::uint32_t> known;
  std::vector<std::uint32_t> new_index(mesh.positions.size());
  SceneMesh welded;
  welded.influence_begin = {0};
  welded.morph_begin = {0};
  std::string key;
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    make_key(mesh, vertex, key);
    const auto next = static_cast<std::uint32_t>(welded.positions.size());
    const auto [entry, is_new] = known.emplace(key, next);
    new_index[vertex] = entry->second;
    if (!is_new) continue;
    welded.positions.push_back(mesh.positions[vertex]);
    for (const Influence& influence : mesh.influences_of(vertex)) welded.influences.push_back(influence);
    for (const MorphDelta& morph : mesh.morphs_of(vertex)) welded.morphs.push_back(morph);
    welded.influence_begin.push_back(welded.influences.size());
    welded.morph_begin.push_back(welded.morphs.size());
  }
  for (Face& face : mesh.mesh.faces) {
    for (std::uint32_t& index : face) index = new_index[index];
  }
  mesh.mesh.vertex_count = static_cast<std::uint32_t>(welded.positions.size());
  mesh.positions = std::move(welded.positions);
  mesh.influences = std::move(welded.influences);
  mesh.influence_begin = std::move(welded.influence_begin);
  mesh.morphs = std::move(welded.morphs);
  mesh.morph_begin = std::move(welded.morph_begin);
}

}  // namespace tvg::cli
