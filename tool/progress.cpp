#include "tool/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace tvg::cli {

ProgressBar::ProgressBar(std::string label, bool quiet, std::string unit)
    : label_(std::move(label)), unit_(std::move(unit)), visible_(!quiet && isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::clear() {
  if (!drawn_) return;
  drawn_ = false;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
}

void ProgressBar::update(std::uint64_t done, std::optional<std::uint64_t> total) {
  if (!visible_) return;
  const auto now = std::chrono::steady_clock::now();
  constexpr auto kInterval = std::chrono::milliseconds(100);
  if (drawn_ && now - last_ < kInterval) return;
  last_ = now;
  drawn_ = true;
  if (!total || *total == 0) {
    fmt::print(stderr, "\r{} {} {}\x1b[K", label_, done, unit_);
  } else {
    constexpr std::uint64_t kWidth = 30;
    const std::uint64_t filled = std::min(kWidth, kWidth * done / *total);
    fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {}/{} {}\x1b[K", label_, "", filled, "", kWidth - filled, done,
               *total, unit_);
  }
  std::fflush(stderr);
}

}  // namespace tvg::cli
