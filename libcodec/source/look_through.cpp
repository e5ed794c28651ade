#include "source/look_through.hpp"

#include "attributes/property_size.hpp"
#include "base/checksum.hpp"
#include "base/errors.hpp"
#include "source/source_checks.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tvg {

namespace {

/// What tells meshes apart, in 64 bits.
class MeshHash {
 public:
  MeshHash(const Mesh& mesh, const MeshProperties& properties) {
    add_number(mesh.vertex_count);
    add(mesh.faces);
    add_number(properties.attributes.size());
    for (const Attribute& attribute : properties.attributes) {
      add_text(attribute.name);
      for (const auto number :
           {static_cast<std::uint64_t>(attribute.kind), static_cast<std::uint64_t>(attribute.domain),
            std::uint64_t{attribute.components}, std::uint64_t{attribute.animated}})
        add_number(number);
      if (!attribute.animated) add(attribute.values);
      add(attribute.corners);
    }
    add_number(properties.parts.size());
    for (const Part& part : properties.parts) {
      for (const std::string* text : {&part.object, &part.group, &part.material}) add_text(*text);
    }
    add(properties.face_parts);
    for (const Polygon& polygon : properties.polygons) {
      add_number(polygon.first_triangle);
      add_number(polygon.corners);
    }
  }

  std::uint64_t value() const { return hash_.value(); }

 private:
  template <class Value>
  void add(const std::vector<Value>& values) {
    add_number(values.size());
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    hash_.update({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  }
  void add_number(std::uint64_t number) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(&number, 1));
    hash_.update({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  }
  void add_text(const std::string& text) {
    add_number(text.size());
    hash_.update({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

  Hasher hash_;
};

/// The meshes of a source in the order in which they come.
class MeshesMet {
 public:
  void add(const SourceStretch& stretch, std::size_t faces) {
    const auto [entry, is_new] = numbers_.try_emplace(stretch.mesh_hash, sizes_.size());
    if (is_new) sizes_.push_back(std::uint64_t{stretch.vertices} + faces);
    order_.push_back(entry->second);
  }

  bool any_returns() const { return sizes_.size() < order_.size(); }

  /// The fewest meshes to keep with which as little as can be is sent again.
  std::uint32_t worth_keeping() const {
    std::uint32_t best = 1;
    if (!any_returns()) return best;
    std::uint64_t least = sent(1);
    for (std::uint32_t kept = 2; kept <= kMostMeshesKept; ++kept) {
      const std::uint64_t size = sent(kept);
      if (size >= least) continue;
      least = size;
      best = kept;
    }
    return best;
  }

 private:
  /// How much is sent where the last `kept` meshes are known.
  std::uint64_t sent(std::uint32_t kept) const {
    std::uint64_t total = 0;
    std::deque<std::size_t> in_force;
    for (const std::size_t mesh : order_) {
      if (std::find(in_force.begin(), in_force.end(), mesh) != in_force.end()) continue;
      total += sizes_[mesh];
      in_force.push_back(mesh);
      if (in_force.size() > kept) in_force.pop_front();
    }
    return total;
  }

  std::unordered_map<std::uint64_t, std::size_t> numbers_;  // by hash
  std::vector<std::uint64_t> sizes_;                        // [mesh]
  std::vector<std::size_t> order_;                          // [stretch], its mesh
};

}  // namespace

std::uint64_t mesh_hash(const FrameSource& source) {
  return MeshHash(source.mesh(), source.properties()).value();
}

Result<std::optional<EncodePlan>> look_through(FrameSource& source, const EncodeProgress& progress) {
  if (!source.rewind()) return std::optional<EncodePlan>();
  EncodePlan plan;
  plan.box.emplace();
  MeshesMet meshes;
  FramePositions frame;
  for (SourceStep step = SourceStep::kMesh;;) {
    if (step == SourceStep::kMesh) {
      const Mesh& mesh = source.mesh();
      if (Status status = check_mesh(mesh); !status.ok()) return status.error();
      plan.stretches.push_back({plan.frames, 0, mesh.vertex_count, mesh_hash(source), plan.frames});
      meshes.add(plan.stretches.back(), mesh.faces.size());
      const auto faces = static_cast<std::uint32_t>(mesh.faces.size());
      plan.vertices = std::max(plan.vertices, mesh.vertex_count);
      plan.faces = std::max(plan.faces, faces);
      plan.property_bytes =
          std::max(plan.property_bytes, property_bytes(source.properties(), mesh.vertex_count, faces));
      plan.animated_frame_bytes = std::max(
          plan.animated_frame_bytes, animated_frame_bytes(source.properties(), mesh.vertex_count, faces));
    } else {
      if (Status status = check_frame(frame, plan.frames); !status.ok()) return status.error();
      plan.box->extend(frame);
      ++plan.frames;
      ++plan.stretches.back().frames;
      if (progress) progress(plan.frames, source.frame_count());
    }
    const Result<SourceStep> next = read_step(source, frame);
    if (!next) return next.error();
    if (*next == SourceStep::kEnd) break;
    step = *next;
  }
  if (plan.frames == 0) return invalid_input("the sequence has no frames");
  if (!source.rewind()) return Error{ErrorCode::kIo, "the input cannot be read a second time"};
  plan.meshes = meshes.worth_keeping();
  plan.mesh_returns = meshes.any_returns();
  return std::optional(std::move(plan));
}

}  // namespace tvg
