#pragma once
#include "base/byte_io.hpp"

#include <cstdint>

#include <tvg/types.hpp>

namespace tvg {

/// What a packet of a GOP is (§4.5): frames have the number of their predictor added, 128 and above may be
/// skipped, others are reserved.
namespace packet_kind {

inline constexpr std::uint8_t kHeader = 0;
inline constexpr std::uint8_t kDigest = 1;
inline constexpr std::uint8_t kFrame = 32;
inline constexpr std::uint8_t kAncillary = 128;

constexpr std::uint8_t frame(Predictor predictor) {
  return static_cast<std::uint8_t>(kFrame + static_cast<std::uint8_t>(predictor));
}
constexpr bool is_frame(std::uint8_t kind) {
  return kind >= kFrame && kind <= frame(Predictor::kShape);
}

}  // namespace packet_kind

/// §4.5: a packet is its kind, the size of its content, the content, and a checksum of all of it that also
/// covers its place in the GOP. Returns the checksum.
std::uint32_t write_packet(ByteWriter& gop, std::uint64_t seed, std::uint8_t kind, Bytes content);

/// The checksum's seed for packet `number` (1 for the first behind the header) of a GOP, from the checksum of
/// its header packet: a packet fits no other place and no other GOP.
constexpr std::uint64_t packet_seed(std::uint32_t header_checksum, std::uint32_t number) {
  return (std::uint64_t{header_checksum} << 32) | number;
}

/// What stands at the beginning of the bytes that follow in a GOP.
struct PacketRead {
  enum class State {
    kWhole,
    kIncomplete,  ///< more bytes are needed to tell
    kBeyond,      ///< its size is none, or leads beyond the payload
    kTooLarge,    ///< its size is above what the head allows
    kDamaged,     ///< its checksum does not fit
  };

  State state = State::kBeyond;
  std::uint8_t kind = 0;
  Bytes content;               ///< without kind, size and checksum
  std::uint32_t checksum = 0;  ///< as it stands
  std::size_t total = 0;       ///< bytes of all of it, where all are there
};

/// Reads the packet with this seed at the front of `bytes`. `left`: bytes that the GOP's payload still has;
/// `most`: what the head allows a packet.
PacketRead read_packet(Bytes bytes, std::uint64_t left, std::uint64_t seed, std::uint32_t most);

}  // namespace tvg
