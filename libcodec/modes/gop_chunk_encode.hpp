#pragma once
#include "container/gop_header.hpp"
#include "modes/channels.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// A frame's packet.
struct EncodedFrame {
  Predictor predictor = Predictor::kSpace;
  std::vector<std::uint8_t> content;
};

/// A GOP's chunk.
struct EncodedGop {
  std::uint32_t frame_count = 0;
  std::vector<std::uint8_t> chunk;
};

/// Writes a GOP: its header (whose counts are made to fit, and whose fields are given without the channels),
/// its frames, whose content is that of positions, and the digest of these; and the other channels. Fails
/// with kLimitExceeded when a packet is larger than `limits` allow.
Result<EncodedGop> write_gop(GopHeader header, std::vector<EncodedFrame> frames, std::uint64_t digest,
                             std::span<const EncodedChannel> others, const StreamLimits& limits);

}  // namespace tvg
