#pragma once
#include "base/byte_io.hpp"

#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// §4.1: version and bounds.
std::vector<std::uint8_t> write_head(const StreamLimits& limits);
Result<StreamHead> read_head(Bytes payload);

/// Whether a head's bounds lie within what the caller allows (§8.1); the message names the first that does
/// not.
Status check_declared(const StreamLimits& declared, const DecoderLimits& allowed);

/// The smallest bounds that hold for streams with either.
StreamLimits larger_limits(const StreamLimits& a, const StreamLimits& b);

}  // namespace tvg
