#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// Frames in whose place another is held: from `first` to before `end`.
struct HeldFrames {
  std::uint64_t first = 0;
  std::uint64_t end = 0;

  std::uint64_t count() const { return end - first; }
};

/// What a command does about a stream's damage: it ends with a message, or with --conceal tells the user and
/// holds the last good frame in the place of those that are lost.
class Concealment {
 public:
  /// `stream`: its name for messages. `allowed`: --conceal was given.
  Concealment(std::string stream, bool allowed) : stream_(std::move(stream)), allowed_(allowed) {}

  /// The frames to hold, none of them outside `wanted` (all frames where absent); nothing where the damage is
  /// no matter of these. Throws ToolError (kInvalidInput) where concealing is not allowed, `what_is_left` of
  /// the output in its message, and where more frames are lost than a damaged number may fill a disk with.
  std::optional<HeldFrames> hold(const Damage& damage, const std::optional<FrameRange>& wanted,
                                 const std::string& what_is_left = "");

  /// Tells the user of an error, once: a stream that is cut reports its end as the cause of a loss, too.
  void tell(const Error& error, const std::string& where = "");
  /// Says nothing any more: the stream is read again.
  void fall_silent() { silent_ = true; }

 private:
  std::string stream_;
  bool allowed_;
  bool silent_ = false;
  std::optional<Error> told_;
};

}  // namespace tvg::cli
