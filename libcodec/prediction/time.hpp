#pragma once
#include "prediction/predictor.hpp"

namespace tvg {

/// The vertex stays where it was. Its smoother rival adds the mean motion of the gate's ends.
struct TimePredictor {
  static constexpr bool kUsesTime = true;

  template <class T>
  static Prediction<T> predict(const Neighbourhood<T>& v) {
    return {v.previous, (v.n_previous - v.n) + (v.p_previous - v.p)};
  }

  template <class T>
  static T predict_seed(const Neighbourhood<T>& v, bool /*has_n*/) {
    return v.previous;
  }
};

}  // namespace tvg
