#pragma once
#include "base/byte_io.hpp"

#include <cstdint>

namespace tvg {

/// §4.5: a packet is its size, its bytes and a checksum that also covers its place in the GOP.
void write_packet(ByteWriter& gop, std::uint64_t seed, Bytes packet);

/// The checksum's seed for packet `index` (1 for the first frame) of a GOP, from the checksums of its header
/// packet and of the mesh chunk it belongs to: a packet fits no other place, GOP or mesh.
constexpr std::uint64_t packet_seed(std::uint32_t header_checksum, std::uint32_t mesh_checksum,
                                    std::uint32_t index) {
  return (std::uint64_t{header_checksum ^ mesh_checksum} << 32) | index;
}

/// What stands at the beginning of the bytes that follow in a GOP.
struct PacketRead {
  enum class State {
    kWhole,
    kIncomplete,  ///< more bytes are needed to tell
    kNone,        ///< it is no packet: its size cannot be
    kDamaged,     ///< its checksum does not fit
  };

  State state = State::kNone;
  Bytes content;               ///< without size and checksum
  std::uint32_t checksum = 0;  ///< of the content
  std::size_t total = 0;       ///< bytes with size and checksum, where all are there
};

/// Reads the packet with this seed at the front of `bytes`. `left`: bytes that the GOP's payload still has;
/// `most`: what the head allows a packet.
PacketRead read_packet(Bytes bytes, std::uint64_t left, std::uint64_t seed, std::uint32_t most);

}  // namespace tvg
