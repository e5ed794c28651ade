#include "encoder/live/pacer.hpp"

#include <thread>

namespace tvg::cli {

void Pacer::wait_for_next() {
  using Clock = std::chrono::steady_clock;
  if (!rate_) return;
  if (next_ == 0) began_ = Clock::now();
  const std::chrono::duration<double> due(static_cast<double>(next_++) / *rate_);
  std::this_thread::sleep_until(began_ + std::chrono::duration_cast<Clock::duration>(due));
}

}  // namespace tvg::cli
