#pragma once
#include "container/gop_header.hpp"
#include "modes/elp_header.hpp"
#include "quantization/number_line.hpp"

#include <cstdint>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Which numbers a GOP in mode lossless has, as its header says it (format-spec §7.9.1).
struct LineChoice {
  bool multiples = false;  ///< of a power of two; otherwise float32 numbers with low bits that are zero
  int low_bits = 0;        ///< that are zero, in the second case
  int exponent = 0;        ///< of the power of two, in the first

  bool operator==(const LineChoice&) const = default;
  NumberLine line() const {
    return multiples ? NumberLine::of_multiples(exponent) : NumberLine::of_floats(low_bits);
  }
};

/// The fields of a GOP's header in mode lossless (format-spec §4.5.1).
struct LosslessHeader {
  Channels channels;
  LineChoice line;
};

/// Without the channels, which come before.
std::vector<std::uint8_t> write_lossless_header(const LineChoice& line);
/// Reads it into `lossless`. kUnsupported where a channel is not known that must be.
Status read_lossless_header(const GopHeader& header, LosslessHeader& lossless);

/// What the headers of a GOP in mode lossless say of it; all vertices count as flagged.
GopInfo lossless_gop_info(const GopHeader& header);

}  // namespace tvg
