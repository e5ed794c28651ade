#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// Which value each corner has, while faces become fans of triangles as MeshBuilder makes them.
class CornerValues {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// A face's corner, counted from 1, before it is added to the mesh, which has so many triangles then.
  void add(std::uint32_t corner, std::uint32_t value, std::size_t triangles) {
    if (value == kNone && corners_.empty() && !used_) return;
    used_ = true;
    if (corners_.size() < 3 * triangles) fill(triangles);
    if (corner == 1) first_ = value;
    if (corner > 2) corners_.insert(corners_.end(), {first_, previous_, value});
    previous_ = value;
  }
  /// Begins a face: what its corners do not say is none.
  void begin_face() { first_ = previous_ = kNone; }
  bool used() const { return used_; }

  /// What was gathered, of a mesh with so many triangles: [triangle][corner], a value or kNone.
  std::vector<std::uint32_t> take(std::size_t triangles) {
    fill(triangles);
    return std::move(corners_);
  }

 private:
  void fill(std::size_t triangles) { corners_.resize(3 * triangles, kNone); }

  std::vector<std::uint32_t> corners_;
  bool used_ = false;
  std::uint32_t first_ = kNone;
  std::uint32_t previous_ = kNone;
};

/// Turns an attribute whose `corners` may be kNone or name values in any order, and whose values need not all
/// be used, into one that has all values used, those of none 0, in the order they had; into one of vertices
/// where the corners of each vertex have the same. Returns how many corners had none. Every index is below
/// value_count() or kNone.
std::size_t settle_corners(Attribute& attribute, std::span<const Face> faces, std::size_t vertex_count);

/// Gives corners of one vertex that have equal values one of them. Indices as for settle_corners().
void share_values(Attribute& attribute, std::span<const Face> faces);

/// Sets numbers that are NaN or infinite to 0; returns how many there were.
std::size_t clear_non_finite(std::span<float> values);

}  // namespace tvg::cli
