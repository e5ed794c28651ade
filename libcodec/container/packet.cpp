#include "container/packet.hpp"

#include "base/checksum.hpp"
#include "container/chunk.hpp"

#include <algorithm>

namespace tvg {

void write_packet(ByteWriter& gop, std::uint64_t seed, Bytes packet) {
  gop.varint(packet.size());
  gop.bytes(packet);
  gop.u32(checksum(packet, seed));
}

// format-spec §4.5
PacketRead read_packet(Bytes bytes, std::uint64_t left, std::uint64_t seed, std::uint32_t most) {
  constexpr std::uint64_t kMostSizeBytes = 10;
  using State = PacketRead::State;
  PacketRead packet;
  ByteReader reader(bytes.first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), left))));
  const std::uint64_t size = reader.varint();
  if (!reader.ok()) {
    if (bytes.size() < std::min(kMostSizeBytes, left)) packet.state = State::kIncomplete;
    return packet;
  }
  const std::size_t prefix = reader.position();
  if (size > most || prefix + size + kChunkChecksumSize > left) return packet;
  packet.content = reader.bytes(size);
  const std::uint32_t expected = reader.u32();
  packet.state = State::kIncomplete;
  if (!reader.ok()) return packet;
  packet.total = reader.position();
  packet.checksum = checksum(packet.content, seed);
  packet.state = packet.checksum == expected ? State::kWhole : State::kDamaged;
  return packet;
}

}  // namespace tvg
