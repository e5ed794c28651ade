#pragma once
#include <cstdint>

// The one interface of all predictors (format-spec §7.2): a predictor is a type with
//   static constexpr bool kUsesTime;                       whether it needs a frame before
//   static Prediction predict(const Neighbourhood&);       for a vertex with a whole gate
//   static std::int32_t predict_seed(const Neighbourhood&, bool has_n);   for one without
namespace tvg {

/// A vertex's neighbourhood in one coordinate, every index on the vertex's own lattice (Algorithm 2 has been
/// applied).
struct Neighbourhood {
  std::int32_t previous;  ///< the vertex itself in the frame before
  std::int32_t n, p, o;   ///< ends of the gate edge and the vertex across it, in this frame
  std::int32_t n_previous, p_previous, o_previous;  ///< the same in the frame before
};

/// A predicted index, and what is known of its error beforehand.
struct Prediction {
  std::int32_t value;
  /// Twice the amount by which `value` lies above a second, smoother estimate: residuals tend to lean the
  /// other way.
  std::int32_t lean;
};

}  // namespace tvg
