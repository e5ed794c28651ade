#pragma once
#include "base/byte_io.hpp"

#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// §4.2: keys and values.
std::vector<std::uint8_t> write_metadata(const Metadata& metadata);
Result<Metadata> read_metadata(Bytes payload);

}  // namespace tvg
