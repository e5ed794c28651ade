#pragma once
#include "prediction/predictor.hpp"

namespace tvg {

/// The vertex stays where it was. Its smoother rival adds the mean motion of the gate's ends.
struct TimePredictor {
  static constexpr bool kUsesTime = true;

  static Prediction predict(const Neighbourhood& v) {
    return {v.previous, -(v.n - v.n_previous) - (v.p - v.p_previous)};
  }

  static std::int32_t predict_seed(const Neighbourhood& v, bool /*has_n*/) { return v.previous; }
};

}  // namespace tvg
