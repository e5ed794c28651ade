#pragma once
#include "measure/criterion.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

// Skeletons, surfaces and inputs for tests of the measure.
namespace tvg::test {

using Joints = std::vector<std::vector<float>>;  ///< [frame][joint][xyz]

/// A criterion's values on a mesh without a skeleton.
inline std::vector<double> evaluate(const char* name, const Mesh& mesh,
                                    const std::vector<FramePositions>& frames,
                                    const Importance& options = {}) {
  const Topology topology(mesh);
  return find_criterion(name)->evaluate({topology, frames, options, {}, {}, {}});
}

/// Shoulder, elbow and hand.
inline Skeleton arm() {
  return {{"shoulder", "elbow", "hand"}, {-1, 0, 1}, {}};
}

/// The arm along x, its elbow at 1, bent there by so many degrees (0: straight) in the plane z = 0.
inline std::vector<float> bent_arm(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {0, 0, 0, 1, 0, 0, static_cast<float>(1 + std::cos(angle)), static_cast<float>(std::sin(angle)), 0};
}

/// A patch of rows x columns vertices, placed by `at(row, column)` -> {x, y, z}; columns close around when
/// `around` is set.
template <class Place>
Sequence patch(std::uint32_t rows, std::uint32_t columns, bool around, Place at) {
  Sequence sequence{{rows * columns, {}}, {{}}, {}};
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      for (const double x : at(r, c)) sequence.frames[0].push_back(static_cast<float>(x));
    }
  }
  const auto vertex = [columns](std::uint32_t r, std::uint32_t c) { return r * columns + c % columns; };
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    for (std::uint32_t c = 0; c + (around ? 0 : 1) < columns; ++c) {
      sequence.mesh.faces.push_back({vertex(r, c), vertex(r, c + 1), vertex(r + 1, c + 1)});
      sequence.mesh.faces.push_back({vertex(r, c), vertex(r + 1, c + 1), vertex(r + 1, c)});
    }
  }
  return sequence;
}

}  // namespace tvg::test
