#include "c_api/support.hpp"

#include <algorithm>

namespace tvg::c_api {

tvg_code unpack_into(const CodedData& data, std::span<std::uint8_t> bytes) {
  const Result<NamedData> unpacked = unpack_data(data);
  if (!unpacked) return code_of(unpacked.error());
  std::copy(unpacked->bytes.begin(), unpacked->bytes.end(), bytes.begin());
  return TVG_OK;
}

}  // namespace tvg::c_api
