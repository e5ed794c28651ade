#include "modes/channels.hpp"

#include "container/numbers.hpp"

namespace tvg {

namespace {

constexpr const char* kSection = "§4.5.1";

}  // namespace

GopInfo gop_info_of(const GopHeader& header, Mode mode) {
  GopInfo info;
  info.first_frame = info.source_frame = header.first_frame;
  info.frame_count = header.frame_count;
  info.mode = mode;
  return info;
}

void write_channels(ByteWriter& writer, std::span<const std::uint64_t> others) {
  writer.varint(1 + others.size());
  writer.varint(kPositionsChannel);
  for (const std::uint64_t channel : others) writer.varint(channel);
}

// format-spec §3.5, §4.5.1
Fault read_channels(ByteReader& reader, Channels& channels) {
  const std::uint64_t count = reader.varint();
  if (!reader.ok() || count == 0 || count > Channels::kMost)
    return {kSection, "the number of the GOP's channels is out of range"};
  channels.count = static_cast<std::size_t>(count);
  AscendingNumbers ascending;
  bool unknown = false;
  for (std::size_t i = 0; i < channels.count; ++i) {
    const std::uint64_t channel = reader.varint();
    if (!reader.ok()) return Fault{kSection, "the GOP's header is too short"};
    if (i == 0 && channel != kPositionsChannel)
      return {kSection, "the first channel of a GOP is not positions"};
    if (!ascending.take(channel)) return {"§3.5", "the channels of a GOP do not ascend"};
    unknown = unknown || (i > 0 && is_required(channel));
    channels.numbers[i] = channel;
  }
  if (unknown)
    return {kSection, "the GOP has a channel that this decoder does not know", ErrorCode::kUnsupported};
  return {};
}

// format-spec §4.5.2
Result<Bytes> positions_piece(const Channels& channels, Bytes packet) {
  ByteReader reader(packet);
  Bytes positions = packet;
  for (std::size_t i = 0; i + 1 < channels.count; ++i) {
    const Bytes piece = reader.bytes(reader.varint());
    if (i == 0) positions = piece;
  }
  if (!reader.ok()) return malformed("§4.5.2", "the pieces of a frame are longer than its packet");
  return positions;
}

Bytes piece_at(const Channels& channels, std::size_t place, Bytes packet) {
  ByteReader reader(packet);
  for (std::size_t i = 0; i + 1 < channels.count; ++i) {
    const Bytes piece = reader.bytes(reader.varint());
    if (i == place) return piece;
  }
  return reader.bytes(reader.left());
}

std::vector<std::uint8_t> write_pieces(std::vector<std::uint8_t> positions,
                                       std::span<const EncodedChannel> others, std::size_t frame) {
  if (others.empty()) return positions;
  ByteWriter packet;
  packet.varint(positions.size());
  packet.bytes(positions);
  for (std::size_t i = 0; i < others.size(); ++i) {
    const std::vector<std::uint8_t>& piece = others[i].pieces[frame];
    if (i + 1 < others.size()) packet.varint(piece.size());
    packet.bytes(piece);
  }
  return packet.take();
}

std::vector<std::uint8_t> write_digest(std::uint64_t positions, std::span<const EncodedChannel> others) {
  ByteWriter digest;
  digest.varint(kPositionsChannel);
  digest.u64(positions);
  for (const EncodedChannel& channel : others) {
    digest.varint(channel.number);
    digest.u64(channel.digest);
  }
  return digest.take();
}

std::uint64_t digest_at(std::size_t place, Bytes packet) {
  ByteReader reader(packet);
  std::uint64_t digest = 0;
  for (std::size_t i = 0; i <= place; ++i) {
    reader.varint();
    digest = reader.u64();
  }
  return digest;
}

// format-spec §4.5.3
Status compare_digest(const Channels& channels, Bytes packet, std::uint64_t decoded) {
  ByteReader reader(packet);
  std::uint64_t positions = 0;
  for (std::size_t i = 0; i < channels.count; ++i) {
    if (reader.varint() != channels.numbers[i])
      return malformed("§4.5.3", "the digests of a GOP are not those of its channels");
    const std::uint64_t digest = reader.u64();
    if (i == 0) positions = digest;
  }
  if (!reader.finished()) return malformed("§4.5.3", "the GOP's digest has a wrong size");
  if (positions == decoded) return {};
  return stream_error(ErrorCode::kDigestMismatch, "§7.6",
                      {"the GOP decoded to other values than were encoded"});
}

}  // namespace tvg
