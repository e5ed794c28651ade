#pragma once
#include <algorithm>
#include <chrono>
#include <limits>

namespace tvg::bench {

/// Seconds of the fastest of three calls, the one the machine disturbed least; no further call is made once
/// three seconds have gone.
template <class Function>
double best_time(Function&& function) {
  double best = std::numeric_limits<double>::infinity();
  double total = 0;
  for (int run = 0; run < 3 && total < 3; ++run) {
    const auto start = std::chrono::steady_clock::now();
    function();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    best = std::min(best, elapsed.count());
    total += elapsed.count();
  }
  return best;
}

}  // namespace tvg::bench
