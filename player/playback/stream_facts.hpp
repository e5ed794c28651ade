#pragma once
#include "player/playback/frame_ring.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg::player {

/// Where a GOP lies.
struct GopMark {
  std::uint64_t first_frame = 0;
  std::uint32_t frame_count = 0;
  std::uint64_t offset = 0;  ///< in the stream, of its chunk
  std::uint64_t bytes = 0;   ///< of its chunk

  bool operator==(const GopMark&) const = default;
};

/// Frames that are lost or in doubt.
struct DamageMark {
  FrameRun frames;  ///< count 0 where nobody can know how many
  std::string message;
};

/// Bytes of one frame's packet.
struct FrameBytes {
  std::uint64_t frame = 0;
  std::uint64_t bytes = 0;
};

using GopMarks = std::shared_ptr<const std::vector<GopMark>>;

/// The frames whose bytes are on hand: those of a GOP that is there in part as far as it reaches, frames
/// taken as equally long. Both lists in ascending order.
std::vector<FrameRun> frames_of_bytes(const std::vector<GopMark>& marks, const std::vector<ByteRange>& bytes);

/// What is known of a stream so far: of its GOPs, its damage, its packets. All of it bounded.
class StreamFacts {
 public:
  /// The stream's index; `end` is the offset of what follows the last GOP. From then on it is what counts.
  void use_index(const std::vector<IndexEntry>& entries, std::uint64_t end);
  void note_gop(const GopMark& mark);
  void note_damage(const Damage& damage, std::uint64_t first_frame);
  void note_frame(std::uint64_t frame, std::uint64_t bytes);
  /// Frames of the whole stream, learnt at its end.
  void note_end(std::uint64_t frames);

  std::optional<std::uint64_t> frame_count() const { return frame_count_; }
  /// Frames up to the end of the last GOP known.
  std::uint64_t known_end() const { return marks_.empty() ? 0 : end_of(marks_.back()); }
  bool has_index() const { return has_index_; }
  /// The GOP that holds `frame`; null where it is not known.
  const GopMark* gop_of(std::uint64_t frame) const;
  GopMarks gop_marks() const;
  const std::vector<DamageMark>& damage() const { return damage_; }
  /// Packets of frames `first` to `last` as far as they were met and are remembered.
  std::vector<FrameBytes> frame_bytes(std::uint64_t first, std::uint64_t last) const;

 private:
  static std::uint64_t end_of(const GopMark& mark) { return mark.first_frame + mark.frame_count; }

  std::vector<GopMark> marks_;
  mutable GopMarks shared_marks_;  ///< a copy for readers, made when somebody asks
  bool has_index_ = false;
  std::optional<std::uint64_t> frame_count_;
  std::vector<DamageMark> damage_;
  std::map<std::uint64_t, std::uint64_t> packets_;
};

}  // namespace tvg::player
