#pragma once
#include "container/gop_header.hpp"

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

/// Writes a GOP: its header (whose counts are made to fit), its frames, and the digest of their positions.
/// Fails with kLimitExceeded when a packet is larger than `limits` allow.
Result<EncodedGop> write_gop(GopHeader header, std::span<const EncodedFrame> frames, std::uint64_t digest,
                             const StreamLimits& limits);

}  // namespace tvg
