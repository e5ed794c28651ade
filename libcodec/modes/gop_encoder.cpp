#include "modes/gop_encoder.hpp"

#include "container/chunk.hpp"
#include "container/gop_header.hpp"
#include "container/packet.hpp"
#include "modes/elp_encode.hpp"
#include "modes/elp_header.hpp"

#include <algorithm>

namespace tvg {

Result<std::vector<std::uint8_t>> encode_gop(const GopInput& input, const CodedMesh& mesh,
                                             const StreamLimits& limits) {
  const auto frame_count = static_cast<std::uint32_t>(input.frames.size());
  ElpEncoder mode(input, mesh);
  const std::vector<std::uint8_t> fields = mode.begin();
  const std::vector<std::uint8_t> header = write_gop_header({.mesh = mesh.id,
                                                             .first_frame = input.first_frame,
                                                             .frame_count = frame_count,
                                                             .packet_count = frame_count + 1,
                                                             .planes = {},
                                                             .mode = kModeElp,
                                                             .fields = fields});
  ByteWriter gop;
  const std::uint32_t header_checksum = write_packet(gop, 0, packet_kind::kHeader, header);
  std::size_t largest_packet = header.size();
  std::uint32_t packet_number = 0;
  for (const FramePositions& frame : input.frames) {
    const std::uint8_t kind = packet_kind::frame(mode.predictor());
    const std::vector<std::uint8_t> packet = mode.take(frame);
    largest_packet = std::max(largest_packet, packet.size());
    write_packet(gop, packet_seed(header_checksum, ++packet_number), kind, packet);
  }
  write_packet(gop, packet_seed(header_checksum, ++packet_number), packet_kind::kDigest,
               write_digest(mode.digest()));

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
