#pragma once
#include "prediction/predictor.hpp"

namespace tvg {

/// The parallelogram of the gate within the frame: n + p - o. Every first frame of a GOP uses it too.
struct SpacePredictor {
  static constexpr bool kUsesTime = false;

  static Prediction predict(const Neighbourhood& v) { return {v.n + v.p - v.o, 0}; }

  /// Without a gate edge, `v.n` is the vertex coded just before, or the middle of the lattice for the first
  /// one.
  static std::int32_t predict_seed(const Neighbourhood& v, bool /*has_n*/) { return v.n; }
};

}  // namespace tvg
