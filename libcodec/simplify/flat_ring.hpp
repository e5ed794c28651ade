#pragma once
#include "simplify/half_edge_mesh.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// A vertex' ring laid into the plane, the vertex at the origin, and triangulations of the hole it leaves.
namespace tvg {

using PlanePoint = std::array<double, 2>;

/// Lays a ring out by z^a: `angles` at the vertex between each neighbour and the next ([place], one fewer
/// than `radii` where the ring is a chain), `radii` the distances to the neighbours. The whole angle becomes
/// 2 pi, or pi for a chain, whose ends then lie on one line with the origin. Radii are relative to their mean
/// and their exponent is 3 at most, so that spikes stay within reach of numbers.
std::vector<PlanePoint> flatten_ring(std::span<const double> angles, std::span<const double> radii,
                                     bool closed);

/// The constrained Delaunay triangulation of a simple polygon, counter-clockwise; empty where it has none
/// whose triangles all have an area. Time grows with the fourth power of the corners, of which there are few.
std::vector<RingTriangle> delaunay_of_polygon(std::span<const PlanePoint> polygon);

/// All triangles from one corner; empty where one of them has no area or is turned over.
std::vector<RingTriangle> fan_of_polygon(std::span<const PlanePoint> polygon, std::uint32_t apex);

/// Twice the signed area.
double doubled_area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Weights of a point's place in a triangle, of sum 1; those of a point outside are below 0.
std::array<double, 3> weights_in(const PlanePoint& point, const PlanePoint& a, const PlanePoint& b,
                                 const PlanePoint& c);

struct PlaneLocation {
  std::size_t triangle = 0;
  std::array<double, 3> weights{};  ///< none below 0, of sum 1
};

/// In which of the triangles ([triangle][corner] points) a point lies; the one it is least outside of, by
/// weights that are cut off at 0, where rounding puts it in none.
PlaneLocation locate(const PlanePoint& point, std::span<const std::array<PlanePoint, 3>> triangles);

}  // namespace tvg
