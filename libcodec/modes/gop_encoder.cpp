#include "modes/gop_encoder.hpp"

#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/packet.hpp"
#include "modes/elp_encode.hpp"

#include <algorithm>

namespace tvg {

Result<std::vector<std::uint8_t>> encode_gop(const GopInput& input, const CodedMesh& mesh,
                                             const StreamLimits& limits) {
  ElpEncoder mode(input, mesh);
  ByteWriter gop;
  const std::vector<std::uint8_t> header = mode.begin();
  write_packet(gop, 0, header);
  const std::uint32_t header_checksum = checksum(header);
  std::size_t largest_packet = header.size();
  std::uint32_t packet_index = 0;
  for (const FramePositions& frame : input.frames) {
    const std::vector<std::uint8_t> packet = mode.take(frame);
    largest_packet = std::max(largest_packet, packet.size());
    write_packet(gop, packet_seed(header_checksum, mesh.payload_checksum, ++packet_index), packet);
  }
  ByteWriter digest;
  digest.u64(mode.digest());
  write_packet(gop, packet_seed(header_checksum, mesh.payload_checksum, ++packet_index), digest.data());

  if (largest_packet > limits.packet_bytes || gop.data().size() > kMaxChunkLength) {
    return Error{ErrorCode::kLimitExceeded,
                 "the GOP is larger than a chunk can be: use fewer frames per GOP",
                 {},
                 input.first_frame,
                 "§4.1"};
  }
  return write_chunk(kGopChunk, false, gop.data());
}

}  // namespace tvg
