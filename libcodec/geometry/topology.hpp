#pragma once
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include <tvg/geometry.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Whether the faces around each vertex form one closed fan, [vertex] 0 or 1; faces that name a vertex twice
/// are left out.
std::vector<std::uint8_t> closed_fans(const Mesh& mesh, const OneRings& rings);

/// What only depends on a mesh's connectivity: made when it is first asked for, and kept. Several threads may
/// ask at once. The mesh, whose indices are valid, must outlive it.
class Topology {
 public:
  explicit Topology(const Mesh& mesh) : mesh_(mesh) {}

  const Mesh& mesh() const { return mesh_; }
  const OneRings& rings() const;
  /// As closed_fans() has them.
  const std::vector<std::uint8_t>& closed_fans() const;

 private:
  const Mesh& mesh_;
  mutable std::once_flag rings_once_, fans_once_;
  mutable std::optional<OneRings> rings_;
  mutable std::vector<std::uint8_t> fans_;
};

}  // namespace tvg
