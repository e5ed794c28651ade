#pragma once
#include "simplify/half_edge_mesh.hpp"
#include "simplify/moving_positions.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// A face is none, or will soon be, when it is this much lower than long.
inline constexpr float kThinnestFace = 1e-3f;
/// Degrees between the normals of two faces at an edge from which on it is a crease, and from which on one
/// lies folded on the other.
inline constexpr double kCreasedDegrees = 150, kFoldedDegrees = 175;

/// Says of a hole, in every frame, whether faces that fill it turn too far away from those that were there.
class FoldCheck {
 public:
  /// `largest_turn` in degrees: between the normal of a new face and the sum of the areas that go, unless one
  /// of the faces that go was further off in that frame; at a boundary half of it between the new edge and
  /// each of the two it replaces. No frame may have more folded edges than
  /// before, nor more creases unless allow_creases().
  FoldCheck(const MovingPositions& positions, double largest_turn);

  /// From now on creases may be sharper than they were, where nothing else is left to remove.
  void allow_creases() { creases_allowed_ = true; }
  /// Turns to the hole of a vertex. `center` is the original's vertex.
  void begin(std::uint32_t center, const Ring& ring);
  /// [place] angles at the center, and distances from it, both their means over the frames.
  std::span<const double> angles() const { return angles_; }
  std::span<const double> radii() const { return radii_; }

  /// Whether the boundary may run straight past the center.
  bool allows_chord() const;
  /// Whether the hole may be filled so.
  bool allows(std::span<const RingTriangle> triangles);

 private:
  /// What rounding may make of an angle, in degrees.
  static constexpr double kMargin = 0.25;

  void judge_star();
  void count_star_folds();
  /// Edges at the faces of a hole that are creased and folded, [frame].
  struct Folds {
    std::vector<int> creased, folded;
    void clear(std::size_t frames);
  };
  /// Adds 1 for each frame in which two normals are so far apart, give or take so many degrees.
  void count_folds(const float* a, const float* b, double margin, Folds& folds) const;
  bool allows_face(const RingTriangle& triangle, float* normal) const;
  bool adds_folds(std::span<const RingTriangle> triangles);

  const MovingPositions& positions_;
  double cosine_, chord_cosine_;
  std::uint32_t center_ = 0;
  const Ring* ring_ = nullptr;
  std::vector<double> angles_, radii_;
  std::vector<float> star_;            ///< [place][axis][frame] area normals of the faces that go
  std::vector<float> sum_;             ///< [axis][frame] of them
  std::vector<float> least_along_;     ///< [frame] of a unit normal along the sum
  std::vector<std::uint8_t> has_sum_;  ///< [frame] whether the faces that go have an area there
  std::vector<float> across_;          ///< [place][axis][frame] of the faces beyond the ring
  std::vector<float> fresh_;           ///< [triangle][axis][frame] of the faces in question
  Folds star_folds_, folds_;           ///< of the faces that go, and of those in question
  bool creases_allowed_ = false;
};

}  // namespace tvg
