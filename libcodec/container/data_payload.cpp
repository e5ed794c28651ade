#include "container/data_payload.hpp"

#include "base/stream_error.hpp"

#include <string_view>

namespace tvg {

// format-spec §4.8
Status check_data(Bytes payload) {
  constexpr std::uint64_t kMostNameBytes = 1024;
  constexpr std::uint64_t kMostDecodedBytes = std::uint64_t{1} << 26;
  constexpr std::uint8_t kStored = 0;
  ByteReader reader(payload);
  const std::uint64_t name_size = reader.varint();
  if (!reader.ok() || name_size == 0 || name_size > kMostNameBytes)
    return malformed("§4.8", "the name of data is empty or too long");
  const Bytes name = reader.bytes(name_size);
  const std::uint8_t encoding = reader.u8();
  const std::uint64_t decoded_size = reader.varint();
  if (!reader.ok()) return malformed("§4.8", "the data chunk is too short");
  if (!is_metadata_text({reinterpret_cast<const char*>(name.data()), name.size()}))
    return malformed("§4.8", "the name of data is no text in UTF-8");
  if (decoded_size > kMostDecodedBytes)
    return stream_error(ErrorCode::kLimitExceeded, "§4.8", {"data are larger than a stream may hold"});
  if (reader.left() > decoded_size || (encoding == kStored && reader.left() != decoded_size))
    return malformed("§4.8", "data do not have the size they are said to have");
  return {};
}

}  // namespace tvg
