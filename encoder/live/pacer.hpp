#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

namespace tvg::cli {

/// Says when each frame of something that happens now is due.
class Pacer {
 public:
  /// `rate`: frames per second; absent where frames come when they come, and none is waited for.
  explicit Pacer(std::optional<double> rate) : rate_(rate) {}

  /// Sleeps until the turn of the next frame: frame n is due n frame times after the first, however long
  /// those before it took. Then counts it.
  void wait_for_next();

 private:
  std::optional<double> rate_;
  std::uint64_t next_ = 0;
  std::chrono::steady_clock::time_point began_{};
};

}  // namespace tvg::cli
