#include "container/packet.hpp"

#include "base/checksum.hpp"
#include "container/chunk.hpp"

#include <algorithm>

namespace tvg {

std::uint32_t write_packet(ByteWriter& gop, std::uint64_t seed, std::uint8_t kind, Bytes content) {
  const std::size_t start = gop.data().size();
  gop.u8(kind);
  gop.varint(content.size());
  gop.bytes(content);
  const std::uint32_t sum = checksum(Bytes(gop.data()).subspan(start), seed);
  gop.u32(sum);
  return sum;
}

// format-spec §4.5
PacketRead read_packet(Bytes bytes, std::uint64_t left, std::uint64_t seed, std::uint32_t most) {
  constexpr std::uint64_t kMostPrefixBytes = 1 + 10;
  using State = PacketRead::State;
  PacketRead packet;
  ByteReader reader(bytes.first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), left))));
  packet.kind = reader.u8();
  const std::uint64_t size = reader.varint();
  if (!reader.ok()) {
    if (bytes.size() < std::min(kMostPrefixBytes, left)) packet.state = State::kIncomplete;
    return packet;
  }
  const std::size_t prefix = reader.position();
  if (size > left || prefix + size + kChunkChecksumSize > left) return packet;
  packet.state = size > most ? State::kTooLarge : State::kIncomplete;
  if (size > most) return packet;
  packet.content = reader.bytes(size);
  const std::uint32_t expected = reader.u32();
  if (!reader.ok()) return packet;
  packet.total = reader.position();
  packet.checksum = expected;
  const std::uint32_t actual = checksum(bytes.first(packet.total - kChunkChecksumSize), seed);
  packet.state = actual == expected ? State::kWhole : State::kDamaged;
  return packet;
}

}  // namespace tvg
