#include "modes/gop_chunk_encode.hpp"

#include "container/chunk.hpp"
#include "container/packet.hpp"
#include "modes/channels.hpp"

#include <algorithm>

namespace tvg {

// format-spec §4.5
Result<EncodedGop> write_gop(GopHeader header, std::span<const EncodedFrame> frames, std::uint64_t digest,
                             const StreamLimits& limits) {
  header.frame_count = static_cast<std::uint32_t>(frames.size());
  header.packet_count = header.frame_count + 1;
  const std::vector<std::uint8_t> header_packet = write_gop_header(header);
  ByteWriter gop;
  const std::uint32_t header_checksum = write_packet(gop, 0, packet_kind::kHeader, header_packet);
  std::size_t largest_packet = header_packet.size();
  std::uint32_t packet_number = 0;
  for (const EncodedFrame& frame : frames) {
    largest_packet = std::max(largest_packet, frame.content.size());
    write_packet(gop, packet_seed(header_checksum, ++packet_number), packet_kind::frame(frame.predictor),
                 frame.content);
  }
  write_packet(gop, packet_seed(header_checksum, ++packet_number), packet_kind::kDigest,
               write_digest(digest));
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
