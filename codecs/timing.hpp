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

/// How often what is timed is run, where nobody says.
constexpr int kUsualRuns = 3;

/// Processor seconds of the fastest of `runs` calls, the one the machine disturbed least; no further call is
/// made once three seconds have gone.
template <class Function>
double best_time(int runs, Function&& function) {
  double best = std::numeric_limits<double>::infinity();
  double total = 0;
  for (int run = 0; run < std::max(1, runs) && total < 3; ++run) {
    const double start = processor_seconds();
    function();
    const double elapsed = processor_seconds() - start;
    best = std::min(best, elapsed);
    total += elapsed;
  }
  return best;
}

/// The same of kUsualRuns.
template <class Function>
double best_time(Function&& function) {
  return best_time(kUsualRuns, function);
}

}  // namespace tvg::bench
