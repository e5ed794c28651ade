#pragma once
#include "prediction/predictor.hpp"

namespace tvg {

/// Dynapack's Extended Lorenzo Predictor (the paper's Eq. 9): the parallelogram of the gate, applied to the
/// motion since the frame before. Its smoother rival is the mean motion of the gate's ends.
struct ElpPredictor {
  static constexpr bool kUsesTime = true;

  template <class Now, class Before>
  static Prediction<IndexIn<Now>> predict(const Scheduled& v, const Now& now, const Before& before) {
    const auto motion_n = now(v.gate.n) - before(v.gate.n);
    const auto motion_p = now(v.gate.p) - before(v.gate.p);
    const auto motion_o = now(v.gate.o) - before(v.gate.o);
    const auto along_edge = motion_n + motion_p;
    return {before(v.vertex) + along_edge - motion_o, along_edge - motion_o - motion_o};
  }

  template <class Now, class Before, class T>
  static T predict_seed(const Scheduled& v, const Now& now, const Before& before, T /*middle*/) {
    const T own = before(v.vertex);
    return v.gate.n == kNoVertex ? own : own + now(v.gate.n) - before(v.gate.n);
  }
};

}  // namespace tvg
