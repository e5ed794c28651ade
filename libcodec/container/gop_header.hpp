#pragma once
#include "base/byte_io.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// §4.5.1: the first packet of a GOP.
struct GopHeader {
  std::uint64_t first_frame;  ///< number of the first frame in the sequence it was encoded from
  std::uint32_t frame_count;
  std::uint8_t predictor;
  std::uint8_t fine_bits, coarse_bits;
  std::array<double, 3> origin;
  double step;
  Bytes flags;  ///< coded flags; empty unless fine_bits > coarse_bits
};
std::vector<std::uint8_t> write_gop_header(const GopHeader& header);
Result<GopHeader> read_gop_header(Bytes packet);

/// Whether a GOP is as short as the head says.
Status check_gop_size(const GopHeader& header, const StreamLimits& limits);

}  // namespace tvg
