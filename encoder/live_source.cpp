#include "encoder/live_source.hpp"

#include <charconv>
#include <cmath>
#include <string_view>
#include <thread>

namespace tvg::cli {

namespace {

std::optional<double> parse_positive(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  if (!whole || !std::isfinite(value) || value <= 0) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> parse_frame_rate(const std::string& text) {
  const std::string_view view = text;
  const std::size_t slash = view.find('/');
  if (slash == std::string_view::npos) return parse_positive(view);
  const auto over = parse_positive(view.substr(0, slash));
  const auto under = parse_positive(view.substr(slash + 1));
  if (!over || !under) return std::nullopt;
  return *over / *under;
}

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
