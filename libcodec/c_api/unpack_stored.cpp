#include "c_api/support.hpp"

#include <algorithm>

// Of a library that only decodes.
namespace tvg::c_api {

tvg_code unpack_into(const CodedData& data, std::span<std::uint8_t> bytes) {
  if (data.encoding != DataEncoding::kStored) return TVG_ERROR_UNSUPPORTED;
  if (data.bytes.size() != bytes.size()) return TVG_ERROR_MALFORMED;
  std::copy(data.bytes.begin(), data.bytes.end(), bytes.begin());
  return TVG_OK;
}

}  // namespace tvg::c_api
