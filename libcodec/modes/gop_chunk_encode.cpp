#include "modes/gop_chunk_encode.hpp"

#include "container/chunk.hpp"
#include "container/packet.hpp"

#include <algorithm>
#include <utility>

namespace tvg {

// format-spec §4.5
Result<EncodedGop> write_gop(GopHeader header, std::vector<EncodedFrame> frames, std::uint64_t digest,
                             std::span<const EncodedChannel> others, const StreamLimits& limits) {
  ByteWriter fields;
  std::vector<std::uint64_t> numbers;
  for (const EncodedChannel& channel : others) numbers.push_back(channel.number);
  write_channels(fields, numbers);
  fields.bytes(header.fields);
  header.fields = fields.data();
  header.frame_count = static_cast<std::uint32_t>(frames.size());
  header.packet_count = header.frame_count + 1;
  const std::vector<std::uint8_t> header_packet = write_gop_header(header);
  ByteWriter gop;
  const std::uint32_t header_checksum = write_packet(gop, 0, packet_kind::kHeader, header_packet);
  std::size_t largest_packet = header_packet.size();
  std::uint32_t packet_number = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const std::vector<std::uint8_t> content = write_pieces(std::move(frames[f].content), others, f);
    largest_packet = std::max(largest_packet, content.size());
    write_packet(gop, packet_seed(header_checksum, ++packet_number), packet_kind::frame(frames[f].predictor),
                 content);
  }
  write_packet(gop, packet_seed(header_checksum, ++packet_number), packet_kind::kDigest,
               write_digest(digest, others));
  if (largest_packet > limits.packet_bytes || gop.data().size() > kMaxChunkLength) {
    return Error{ErrorCode::kLimitExceeded,
                 "the GOP is larger than a chunk can be: use fewer frames per GOP",
                 {},
                 header.first_frame,
                 "§4.1"};
  }
  return EncodedGop{header.frame_count, write_chunk(kGopChunk, false, gop.data())};
}

}  // namespace tvg
