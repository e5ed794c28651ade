#pragma once
#include "prediction/predictor.hpp"

namespace tvg {

/// The parallelogram of the gate within the planes: n + p - o. Every first frame of a GOP uses it.
struct SpacePredictor {
  static constexpr bool kUsesTime = false;

  template <class Now, class Before>
  static Prediction<IndexIn<Now>> predict(const Scheduled& v, const Now& now, const Before& /*before*/) {
    const auto value = now(v.gate.n) + now(v.gate.p) - now(v.gate.o);
    return {value, {}};
  }

  template <class Now, class Before, class T>
  static T predict_seed(const Scheduled& v, const Now& now, const Before& /*before*/, T middle) {
    return v.nearest == kNoVertex ? middle : now(v.nearest);
  }
};

}  // namespace tvg
