#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace tvg::cli {

/// A progress bar on standard error: drawn only when that is a terminal, and not after --quiet. It is redrawn
/// a few times a second at most and erased in the end.
class ProgressBar {
 public:
  /// `unit`: what is counted.
  ProgressBar(std::string label, bool quiet, std::string unit = "frames");
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `done` of `total`; without a total only the count is shown.
  void update(std::uint64_t done, std::optional<std::uint64_t> total);

  /// Erases the bar, so that other text can take its line; the next update draws it again.
  void clear();

 private:
  std::string label_;
  std::string unit_;
  bool visible_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace tvg::cli
