#include "tool/concealment.hpp"

#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

/// Frames that are held at a stretch: a damaged number must not fill the disk.
constexpr std::uint64_t kMostHeld = std::uint64_t{1} << 20;

HeldFrames frames_of(const Damage& damage, const std::optional<FrameRange>& wanted) {
  constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();
  HeldFrames frames{damage.first_frame,
                    damage.first_frame + std::min(damage.frame_count, kLast - damage.first_frame)};
  if (!wanted) return frames;
  frames.first = std::max(frames.first, wanted->first);
  if (wanted->last < kLast) frames.end = std::min(frames.end, wanted->last + 1);
  frames.end = std::max(frames.first, frames.end);
  return frames;
}

}  // namespace

std::optional<HeldFrames> Concealment::hold(const Damage& damage, const std::optional<FrameRange>& wanted,
                                            const std::string& what_is_left) {
  const HeldFrames frames = frames_of(damage, wanted);
  if (wanted && frames.count() == 0) return std::nullopt;
  const std::string where =
      damage.frame_count > 0 ? frame_run(damage.first_frame, damage.frame_count) + " lost: " : "";
  const std::string text = fmt::format("{}: {}{}", stream_, where, damage.error.describe());
  if (!allowed_) {
    throw ToolError(ExitStatus::kInvalidInput,
                    fmt::format("{}{}{} (--conceal holds the last good frame instead)", text,
                                what_is_left.empty() ? "" : "; ", what_is_left));
  }
  if (frames.count() > kMostHeld) throw ToolError(ExitStatus::kInvalidInput, text);
  tell(damage.error, where);
  return frames;
}

void Concealment::tell(const Error& error, const std::string& where) {
  const bool same = told_ && told_->code == error.code && told_->byte_offset == error.byte_offset;
  told_ = error;
  if (!silent_ && !same) fmt::print(stderr, "tvg: {}: {}{}\n", stream_, where, error.describe());
}

}  // namespace tvg::cli
