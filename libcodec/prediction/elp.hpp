#pragma once
#include "prediction/predictor.hpp"

namespace tvg {

/// Dynapack's Extended Lorenzo Predictor (the paper's Eq. 9): the parallelogram of the gate, applied to the
/// motion since the frame before. Its smoother rival is the mean motion of the gate's ends.
struct ElpPredictor {
  static constexpr bool kUsesTime = true;

  template <class T>
  static Prediction<T> predict(const Neighbourhood<T>& v) {
    const T motion_n = v.n - v.n_previous;
    const T motion_p = v.p - v.p_previous;
    const T motion_o = v.o - v.o_previous;
    return {v.previous + motion_n + motion_p - motion_o, motion_n + motion_p - 2 * motion_o};
  }

  template <class T>
  static T predict_seed(const Neighbourhood<T>& v, bool has_n) {
    return has_n ? v.previous + (v.n - v.n_previous) : v.previous;
  }
};

}  // namespace tvg
