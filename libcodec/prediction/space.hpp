#pragma once
#include "prediction/predictor.hpp"

namespace tvg {

/// The parallelogram of the gate within the frame: n + p - o. Every first frame of a GOP uses it too.
struct SpacePredictor {
  static constexpr bool kUsesTime = false;

  template <class T>
  static Prediction<T> predict(const Neighbourhood<T>& v) {
    return {v.n + v.p - v.o, T{}};
  }

  /// Without a gate edge, `v.n` is the vertex coded just before, or the middle of the lattice for the first
  /// one.
  template <class T>
  static T predict_seed(const Neighbourhood<T>& v, bool /*has_n*/) {
    return v.n;
  }
};

}  // namespace tvg
