#pragma once
#include "prediction/schedule.hpp"

#include <cstdint>
#include <type_traits>

// The one interface of all predictors (format-spec §7.2): a predictor is a type with
//   kUsesTime                            whether it needs reference planes,
//   predict(v, now, before)              the Prediction for a scheduled vertex with a whole gate,
//   predict_seed(v, now, before, middle) the predicted index for one without; `middle` stands in for planes
//                                        where no vertex has had its turn.
// `now(w)` is vertex w's index in the planes that are coded, `before(w)` that in the reference planes, both
// on the lattice of the vertex that is predicted (Algorithm 2 has been applied): an integer or a vector of
// them.
namespace tvg {

/// A predicted index, and what is known of its error beforehand.
template <class T>
struct Prediction {
  T value;
  /// Twice the amount by which `value` lies above a second, smoother estimate: residuals tend to lean the
  /// other way.
  T lean;
};

/// What a view of planes gives for a vertex.
template <class View>
using IndexIn = std::invoke_result_t<const View&, std::uint32_t>;

}  // namespace tvg
