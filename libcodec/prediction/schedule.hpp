#pragma once
#include "connectivity/connectivity.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

// The order in which the vertices of a plane are coded, and what each one is predicted from (format-spec
// §7.2).
namespace tvg {

/// A vertex whose turn it is. All vertices it refers to have had theirs.
struct Scheduled {
  std::uint32_t vertex;  ///< where its integer stands in a plane
  Gate gate;  ///< the ends of the edge it is reached through and the vertex across, as far as there are any
  std::uint32_t nearest;  ///< gate.n; without it, the vertex whose turn was before; kNoVertex for the first

  /// Whether it has a whole gate; without one it is a seed.
  bool whole() const { return gate.o != kNoVertex; }
};

/// The schedule of a mesh: both sides make it from what they share. It refers to what it is made from.
class Schedule {
 public:
  /// Along the traversal; `gates` are [traversal index], and so are planes.
  explicit Schedule(std::span<const Gate> gates) : gates_(gates) {}

  std::size_t size() const { return gates_.size(); }
  Scheduled operator[](std::size_t turn) const {
    const auto vertex = static_cast<std::uint32_t>(turn);
    const Gate& gate = gates_[turn];
    return {vertex, {gate.n, gate.p, gate.o}, gate.n != kNoVertex || turn == 0 ? gate.n : vertex - 1};
  }

 private:
  std::span<const Gate> gates_;
};

}  // namespace tvg
