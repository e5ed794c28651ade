#pragma once
#include <cstdint>

// The one interface of all predictors (format-spec §7.2): a predictor is a type with
//   kUsesTime              whether it needs a frame before,
//   predict(v)             the Prediction for a vertex with a whole gate,
//   predict_seed(v, has_n) the predicted index for one without; `has_n` says whether the gate has an n.
// T is std::int32_t, or a vector of them with the same operators.
namespace tvg {

/// A vertex's neighbourhood in one coordinate, every index on the vertex's own lattice (Algorithm 2 has been
/// applied).
template <class T>
struct Neighbourhood {
  T previous;                            ///< the vertex itself in the frame before
  T n, p, o;                             ///< ends of the gate edge and the vertex across it, in this frame
  T n_previous, p_previous, o_previous;  ///< the same in the frame before
};

/// A predicted index, and what is known of its error beforehand.
template <class T>
struct Prediction {
  T value;
  /// Twice the amount by which `value` lies above a second, smoother estimate: residuals tend to lean the
  /// other way.
  T lean;
};

}  // namespace tvg
