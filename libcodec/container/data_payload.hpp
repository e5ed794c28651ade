#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"

#include <vector>

#include <tvg/data.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// The payload of a chunk of free-form data (§4.8), compressed where that is smaller. Part of the encoding
/// half.
std::vector<std::uint8_t> write_data(const NamedData& data);
/// Reads such a payload, in which name and bytes then lie; what the data are is not looked at.
Fault read_data(Bytes payload, CodedData& data);

}  // namespace tvg
