#include "encoder/live/live_source.hpp"

#include <thread>

namespace tvg::cli {

/// Frame n is due n frame times after the first, however long those before it took.
void LiveSource::wait_for_turn() {
  if (!input_.pace) return;
  const auto now = std::chrono::steady_clock::now();
  if (frames_ == 0) began_ = now;
  const std::chrono::duration<double> due(static_cast<double>(frames_) / *input_.pace);
  std::this_thread::sleep_until(began_ +
                                std::chrono::duration_cast<std::chrono::steady_clock::duration>(due));
}

Result<bool> LiveSource::read_frame(std::span<float> positions) {
  if (cut_short_) return false;
  wait_for_turn();
  Result<bool> read = source_.read_frame(positions);
  if (read && !*read && input_.loop && frames_ > 0 && source_.rewind()) read = source_.read_frame(positions);
  if (!read && input_.open_ended && read.error().code == ErrorCode::kTruncated) {
    cut_short_ = read.error().message;
    return false;
  }
  if (read && *read) ++frames_;
  return read;
}

}  // namespace tvg::cli
