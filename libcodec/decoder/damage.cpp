#include "decoder/damage.hpp"

#include "base/stream_error.hpp"

#include <algorithm>
#include <utility>

namespace tvg {

namespace {

/// Labels are made up as easily as not: what they say is lost never counts further than a label can.
constexpr std::uint64_t kMostFrames = std::uint64_t{1} << 62;

}  // namespace

Damage DamageLedger::lose(std::uint64_t frames, Error cause) {
  cause.frame = position_;
  Damage damage;
  damage.first_frame = position_;
  damage.frame_count = frames;
  damage.error = std::move(cause);
  position_ += frames;
  return damage;
}

Damage DamageLedger::doubt(std::uint64_t first_frame, std::uint64_t frames, Error cause) {
  cause.frame = first_frame;
  Damage damage;
  damage.first_frame = first_frame;
  damage.frame_count = frames;
  damage.error = std::move(cause);
  return damage;
}

void DamageLedger::lose_unknown(Error cause) {
  searched_ = true;
  if (!unknown_) unknown_ = std::move(cause);
}

std::uint64_t DamageLedger::meet_gop(std::uint64_t label, std::uint32_t frame_count,
                                     const StreamMap::Place* place) {
  std::uint64_t missing = 0;
  if (std::exchange(searched_, false)) {
    if (place != nullptr) {
      missing = place->first_frame > position_ ? place->first_frame - position_ : 0;
    } else if (label_known_ && label > expected_label_) {
      missing = label - expected_label_;
    }
    missing = std::min(missing, kMostFrames - std::min(position_, kMostFrames));
    if (missing > 0 && !unknown_) unknown_ = malformed("§8.3", "the damage reaches into the next GOP");
  }
  expected_label_ = label + frame_count;
  label_known_ = true;
  return missing;
}

Error DamageLedger::take_cause(Error otherwise) {
  return unknown_ ? *std::exchange(unknown_, std::nullopt) : std::move(otherwise);
}

Damage DamageLedger::settle_unknown() {
  Damage damage = lose(0, *std::exchange(unknown_, std::nullopt));
  damage.count_known = false;
  return damage;
}

void DamageLedger::jump(std::uint64_t frame) {
  position_ = frame;
  label_known_ = false;
  searched_ = false;
  unknown_.reset();
}

}  // namespace tvg
