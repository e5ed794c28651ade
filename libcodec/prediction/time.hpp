#pragma once
#include "prediction/predictor.hpp"

namespace tvg {

/// The vertex stays where it was. Its smoother rival adds the mean motion of the gate's ends.
struct TimePredictor {
  static constexpr bool kUsesTime = true;

  template <class Now, class Before>
  static Prediction<IndexIn<Now>> predict(const Scheduled& v, const Now& now, const Before& before) {
    const auto& [n, p, o] = v.gate;
    return {before(v.vertex), (before(n) - now(n)) + (before(p) - now(p))};
  }

  template <class Now, class Before, class T>
  static T predict_seed(const Scheduled& v, const Now& /*now*/, const Before& before, T /*middle*/) {
    return before(v.vertex);
  }
};

}  // namespace tvg
