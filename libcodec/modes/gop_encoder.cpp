#include "modes/gop_encoder.hpp"

#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/gop_header.hpp"
#include "container/packet.hpp"
#include "entropy/range_coder.hpp"
#include "planes/frame_coder.hpp"
#include "quantization/flag_coder.hpp"

#include <algorithm>

namespace tvg {

namespace {

/// Flags in traversal order; empty when there is one lattice only.
std::vector<std::uint8_t> flags_in_traversal_order(const GopInput& input, const CodedMesh& mesh) {
  std::vector<std::uint8_t> flags;
  if (!input.lattice.hybrid()) return flags;
  flags.resize(mesh.order.size());
  for (std::size_t v = 0; v < flags.size(); ++v) flags[v] = input.flags[mesh.order[v]];
  return flags;
}

/// Quantizes a frame to the fine lattice; what has no flag then loses the bits its own lattice does not have.
void quantize_frame(const FramePositions& frame, const CodedMesh& mesh, std::span<const std::uint8_t> flags,
                    const Lattice& lattice, std::span<Quad> indices) {
  const int shift = lattice.shift();
  for (std::size_t v = 0; v < indices.size(); ++v) {
    const bool fine = flags.empty() || flags[v] != 0;
    indices[v] = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t index =
          quantize(frame[3 * std::size_t{mesh.order[v]} + axis], lattice.origin[axis], lattice);
      indices[v][axis] = fine ? index : pad_to_fine(shift_to_coarse(index, shift), shift);
    }
  }
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_gop(const GopInput& input, const CodedMesh& mesh,
                                             const StreamLimits& limits) {
  const Lattice& lattice = input.lattice;
  std::vector<std::uint8_t> flags = flags_in_traversal_order(input, mesh);
  std::vector<std::uint8_t> coded_flags;
  RangeEncoder coder;
  if (lattice.hybrid()) {
    code_flags(coder, mesh.gates, flags);
    coded_flags = coder.finish();
  }

  ByteWriter gop;
  const std::vector<std::uint8_t> header = write_gop_header(
      {input.first_frame, static_cast<std::uint32_t>(input.frames.size()),
       static_cast<std::uint8_t>(input.predictor), static_cast<std::uint8_t>(lattice.fine_bits),
       static_cast<std::uint8_t>(lattice.coarse_bits), lattice.origin, lattice.step, coded_flags});
  write_packet(gop, 0, header);
  const std::uint32_t header_checksum = checksum(header);

  FrameCoder frames(mesh.gates, flags, lattice, input.predictor);
  Hasher digest;
  std::size_t largest_packet = header.size();
  std::uint32_t packet_index = 0;
  for (const FramePositions& frame : input.frames) {
    frames.next_frame();
    quantize_frame(frame, mesh, flags, lattice, frames.indices());
    frames.code(coder);
    digest.update(
        std::span<const std::int32_t>(frames.indices().front().data(), 4 * frames.indices().size()));
    const std::vector<std::uint8_t> packet = coder.finish();
    largest_packet = std::max(largest_packet, packet.size());
    write_packet(gop, packet_seed(header_checksum, mesh.payload_checksum, ++packet_index), packet);
  }
  ByteWriter trailer;
  trailer.u64(digest.value());
  write_packet(gop, packet_seed(header_checksum, mesh.payload_checksum, ++packet_index), trailer.data());

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
