#pragma once
#include <algorithm>
#include <ctime>
#include <limits>

namespace tvg::bench {

/// Seconds of processor time that this process has spent: what is timed runs in one thread, and other jobs
/// on the machine disturb it less than time on the clock.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Processor seconds of the fastest of three calls, the one the machine disturbed least; no further call is
/// made once three seconds have gone.
template <class Function>
double best_time(Function&& function) {
  double best = std::numeric_limits<double>::infinity();
  double total = 0;
  for (int run = 0; run < 3 && total < 3; ++run) {
    const double start = processor_seconds();
    function();
    const double elapsed = processor_seconds() - start;
    best = std::min(best, elapsed);
    total += elapsed;
  }
  return best;
}

}  // namespace tvg::bench
