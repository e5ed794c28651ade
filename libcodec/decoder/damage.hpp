#pragma once
#include <cstdint>
#include <optional>

#include <tvg/decoder.hpp>

namespace tvg {

/// Keeps count of a stream's frames and of those that are missing, and says who is told what of them
/// (format-spec §8.3). A loss whose extent is not known when it is met is kept back: the next GOP's label,
/// the index, or the place the index gives a GOP tells how much it was.
class DamageLedger {
 public:
  /// Number of the next frame in the stream.
  std::uint64_t position() const { return position_; }
  void advance(std::uint64_t frames) { position_ += frames; }

  /// Frames are missing, from the next one on; 0 where something is wrong by which none is lost.
  Damage lose(std::uint64_t frames, Error cause);
  /// Frames that were given out, or are just being read, are not what was encoded.
  static Damage doubt(std::uint64_t first_frame, std::uint64_t frames, Error cause);

  /// Something is lost; what follows tells how much.
  void lose_unknown(Error cause);
  /// Chunks may have been passed over unseen.
  void search() { searched_ = true; }

  /// A GOP is met with this label; `place` is where the index has it, or null. Frames that damage before it
  /// has taken.
  std::uint64_t meet_gop(std::uint64_t label, std::uint32_t frame_count, const StreamMap::Place* place);
  /// An index is met whose GOPs have so many frames. Those that damage has taken.
  std::uint64_t meet_index(std::uint64_t frames) const { return frames > position_ ? frames - position_ : 0; }
  /// Whether chunks may have been passed over since the last GOP.
  bool searched() const { return searched_; }

  bool has_unknown() const { return unknown_.has_value(); }
  /// The cause of a loss whose extent is known now, or `otherwise`.
  Error take_cause(Error otherwise);
  /// Nobody will tell any more how much was lost: call only where has_unknown().
  Damage settle_unknown();

  /// Goes on before the frame with this number.
  void jump(std::uint64_t frame);

 private:
  std::uint64_t position_ = 0;
  std::uint64_t expected_label_ = 0;  ///< of the next GOP, if nothing was cut out
  bool label_known_ = true;
  bool searched_ = false;
  std::optional<Error> unknown_;  ///< damage of unknown extent
};

}  // namespace tvg
