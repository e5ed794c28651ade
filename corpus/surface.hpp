#pragma once
#include "corpus/exact_math.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <tvg/source.hpp>

// Building blocks of the generators: a triangle mesh in binary64 and the shapes it is put together from.
namespace tvg::corpus {

struct Surface {
  std::vector<Vec3> points;
  std::vector<Face> faces;

  std::uint32_t size() const { return static_cast<std::uint32_t>(points.size()); }

  /// Adds a vertex and returns its index.
  std::uint32_t add_point(const Vec3& point);
  /// Adds the quad a b c d (counter-clockwise) as two triangles.
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  /// Adds all of `other`, its indices shifted.
  void append(const Surface& other);
};

/// The surface of the cube [-1, 1]^3 with `cells` x `cells` quads to a side, corners and edges shared:
/// 6 cells^2 + 2 vertices.
Surface make_cube(std::uint32_t cells);

/// `make_cube` pushed out to the unit sphere.
Surface make_ball(std::uint32_t cells);

/// A closed surface with the topology of a torus, `around` * `across` vertices. `point(a, c)` places the
/// vertex at the turns a around the axis and c around the cross-section, both in [0, 1).
Surface make_ring(std::uint32_t around, std::uint32_t across,
                  const std::function<Vec3(double, double)>& point);

/// The points as a frame, each coordinate rounded to float32.
FramePositions to_frame(std::span<const Vec3> points);

}  // namespace tvg::corpus
