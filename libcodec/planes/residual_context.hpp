#pragma once
#include "planes/residual_models.hpp"
#include "prediction/predictor.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

// Which models code a residual (format-spec §7.3.1): chosen from what both sides know before it.
namespace tvg {

/// Sets of models, by the lattices that a vertex and the three vertices of its gate lie on.
enum GateKind : std::size_t {
  kOneLattice = 0,     ///< all four on the same, or no whole gate
  kFineAmongNone = 1,  ///< an important vertex, none of its gate's vertices is
  kFineAmongOne = 2,
  kFineAmongTwo = 3,
  kCoarse = 4,       ///< another vertex, nor is any of its gate's important
  kCoarseMixed = 5,  ///< another vertex, some of its gate's are important
};
inline constexpr std::size_t kGateKindCount = 6;

/// -largest to largest as 0 to 2 largest.
inline std::uint32_t clamped(std::int32_t value, std::int32_t largest) {
  return static_cast<std::uint32_t>(std::clamp(value, -largest, largest) + largest);
}

/// What is known of one coordinate of a vertex with a whole gate. Residuals are on the fine lattice.
struct CoordinateFacts {
  std::array<std::int32_t, 3> gate_residuals;  ///< at n, p and o, in this frame
  std::int32_t own_residual;                   ///< in the frame before; 0 in the first
  std::int32_t lean;                           ///< Prediction::lean
};

inline std::int32_t activity_around(const CoordinateFacts& facts) {
  const auto& [n, p, o] = facts.gate_residuals;
  return 2 * (std::abs(n) + std::abs(p)) + std::abs(o) + 3 * std::abs(facts.own_residual);
}

/// The choice when all of a gate lies on one lattice; `shift` leads from the fine lattice to the vertex's
/// own.
inline ModelChoice choose_models(std::size_t set, const CoordinateFacts& facts, int shift) {
  const std::uint32_t lean = 3 * clamped(facts.lean, 2);
  return {set, static_cast<std::uint32_t>(activity_around(facts) >> shift),
          lean + clamped(facts.gate_residuals[0] + facts.gate_residuals[1], 1),
          lean + clamped(facts.own_residual, 1)};
}

/// How far the coarse vertices of a gate pull the prediction of an important vertex: each one's motion is
/// held against the mean motion of the gate's important vertices, or, without any, half of the lean is taken.
/// `motion` and `fine` are those of n, p and o.
inline std::int32_t coarse_pull(const std::array<std::int32_t, 3>& motion, const std::array<bool, 3>& fine,
                                std::int32_t lean) {
  std::int32_t sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += fine[i] ? motion[i] : 0;
    count += fine[i] ? 1 : 0;
  }
  if (count == 0) return lean >> 1;
  const std::int32_t mean = sum >> (count - 1);
  return (fine[0] ? 0 : motion[0] - mean) + (fine[1] ? 0 : motion[1] - mean) -
         (fine[2] ? 0 : motion[2] - mean);
}

/// The choice for an important vertex some of whose gate is coarse, in a frame predicted from the one before.
/// `pull` is in units of a quarter coarse cell.
inline ModelChoice choose_models_pulled(std::size_t set, const CoordinateFacts& facts, std::int32_t pull) {
  const std::uint32_t second =
      set == kFineAmongTwo
          ? 3 * clamped(facts.lean, 2) + clamped(facts.own_residual, 1)
          : 3 * clamped((pull + (pull > 0 ? 1 : 0)) / 2, 2) + clamped(facts.own_residual / 2, 1);
  return {set, static_cast<std::uint32_t>(activity_around(facts)), clamped(pull, 7), second};
}

}  // namespace tvg
