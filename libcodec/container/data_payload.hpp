#pragma once
#include "base/byte_io.hpp"

#include <tvg/types.hpp>

namespace tvg {

/// Whether this is the payload of a chunk of free-form data (§4.8); what the data are is not looked at.
Status check_data(Bytes payload);

}  // namespace tvg
