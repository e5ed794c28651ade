#include "modes/gop_encoder.hpp"

#include "container/chunk.hpp"
#include "container/gop_header.hpp"
#include "container/packet.hpp"
#include "modes/elp_encode.hpp"
#include "modes/elp_header.hpp"

#include <algorithm>

namespace tvg {

Result<std::vector<std::uint8_t>> encode_gop(const GopInput& input, const GopMesh& mesh,
                                             const StreamLimits& limits) {
  const auto frame_count = static_cast<std::uint32_t>(input.frames.size());
  ElpEncoder mode(input, mesh);
  std::vector<EncodedFrame> frames;
  for (const FramePositions& frame : input.frames) frames.push_back(mode.take(frame));
  const std::vector<std::uint8_t> fields = mode.finish();
  const std::vector<std::uint8_t> header = write_gop_header({.mesh = mesh.coded.id,
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
  for (const EncodedFrame& frame : frames) {
    largest_packet = std::max(largest_packet, frame.content.size());
    write_packet(gop, packet_seed(header_checksum, ++packet_number), packet_kind::frame(frame.predictor),
                 frame.content);
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
