#pragma once
#include "planes/lanes.hpp"
#include "planes/residual_models.hpp"
#include "prediction/predictor.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

// Which models code the residuals of a vertex in mode elp (format-spec §7.3.1): chosen from what both sides
// know before them.
namespace tvg {

/// On which of two nested lattices a vertex and those of its gate lie.
struct GateLattices {
  int nested;                ///< bits between the two lattices
  int shift;                 ///< from the fine lattice to the vertex's own: 0 or `nested`
  std::array<bool, 3> fine;  ///< whether n, p and o lie on the fine lattice

  int fine_count() const { return int{fine[0]} + int{fine[1]} + int{fine[2]}; }
};

/// The contexts of PlaneCoder in mode elp. Residuals are those of this frame where coded, else those of the
/// frame before, and on the fine lattice.
struct ElpContext {
  /// Sets of models, by the lattices that a vertex and the three vertices of its gate lie on.
  enum Set : std::size_t {
    kOneLattice = 0,     ///< all four on the same, or no whole gate
    kFineAmongNone = 1,  ///< an important vertex, none of its gate's vertices is
    kFineAmongOne = 2,
    kFineAmongTwo = 3,
    kCoarse = 4,       ///< another vertex, nor is any of its gate's important
    kCoarseMixed = 5,  ///< another vertex, some of its gate's are important
  };
  static constexpr std::size_t set_count(bool hybrid) { return hybrid ? 6 : 1; }

  /// The choice for a vertex with a whole gate where all lie on one lattice.
  template <class Residuals>
  static GroupChoice on_one_lattice(const Scheduled& v, const Residuals& residuals, Lanes lean) {
    const Lanes at_n = residuals(v.gate.n), at_p = residuals(v.gate.p), own = residuals(v.vertex);
    const Lanes sizes = abs(at_n) + abs(at_p), own_size = abs(own);
    const Lanes middle = thrice(clamp<2>(lean)) + Lanes::all(3 * 2 + 1);
    return {kOneLattice, twice(sizes) + abs(residuals(v.gate.o)) + thrice(own_size),
            middle + clamp<1>(at_n + at_p), middle + clamp<1>(own)};
  }

  /// The choice for a vertex with a whole gate on two lattices. `now` and `before` are as predictors see
  /// them.
  template <class P, class Residuals, class Now, class Before>
  static GroupChoice on_two_lattices(const Scheduled& v, const Residuals& residuals, Lanes lean,
                                     const GateLattices& lattices, const Now& now, const Before& before) {
    GroupChoice choice = on_one_lattice(v, residuals, lean);
    const int fine_count = lattices.fine_count();
    if (lattices.shift != 0) {
      choice.set = fine_count == 0 ? kCoarse : kCoarseMixed;
      choice.activity = choice.activity >> lattices.shift;
    } else if (fine_count < 3) {
      choice.set = kFineAmongNone + static_cast<std::size_t>(fine_count);
      if constexpr (P::kUsesTime) {
        const auto motion = [&](std::uint32_t w) { return now(w) - before(w); };
        const Lanes pull =
            coarse_pull({motion(v.gate.n), motion(v.gate.p), motion(v.gate.o)}, lattices, lean);
        choice.first = clamp<7>(pull) + Lanes::all(7);
        if (fine_count < 2)
          choice.second = thrice(clamp<2>(half(pull - (pull > 0)))) + clamp<1>(half(residuals(v.vertex))) +
                          Lanes::all(3 * 2 + 1);
      }
    }
    return choice;
  }

  /// The choice for a seed; `alone` when there are no reference planes.
  template <class Residuals>
  static GroupChoice of_seed(const Scheduled& v, const Residuals& residuals, int shift, bool alone) {
    constexpr std::int32_t kNearActivity = 64;
    constexpr std::int32_t kFarActivity = 255;
    const Lanes own = residuals(v.vertex);
    const Lanes activity =
        alone ? Lanes::all(v.gate.n == kNoVertex ? kFarActivity : kNearActivity) : abs(own) << 3;
    const Lanes middle = Lanes::all(3 * 2 + 1);
    return {kOneLattice, activity >> shift, middle, middle + clamp<1>(own)};
  }

 private:
  /// How far the coarse vertices of a gate pull the prediction of an important vertex, in quarters of a
  /// coarse cell: each one's motion is held against the mean motion of the gate's important vertices, or,
  /// without any, half of the lean is taken. `motion` is that of n, p and o; one of them is coarse at least.
  static Lanes coarse_pull(const std::array<Lanes, 3>& motion, const GateLattices& lattices, Lanes lean) {
    const int quarter = lattices.nested > 2 ? lattices.nested - 2 : 0;
    const int fine_count = lattices.fine_count();
    if (fine_count == 0) return (lean >> 1) >> quarter;
    Lanes sum;
    for (std::size_t i = 0; i < 3; ++i) {
      if (lattices.fine[i]) sum = sum + motion[i];
    }
    const Lanes mean = sum >> (fine_count - 1);
    Lanes pull;
    if (!lattices.fine[0]) pull = pull + motion[0] - mean;
    if (!lattices.fine[1]) pull = pull + motion[1] - mean;
    if (!lattices.fine[2]) pull = pull - motion[2] + mean;
    return pull >> quarter;
  }
};

}  // namespace tvg
