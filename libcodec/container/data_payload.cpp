#include "container/data_payload.hpp"

#include "base/stream_error.hpp"

#include <string_view>

namespace tvg {

namespace {

// format-spec §4.8
Fault fault_in(ByteReader reader) {
  constexpr const char* kSection = "§4.8";
  constexpr std::uint64_t kMostNameBytes = 1024;
  constexpr std::uint64_t kMostDecodedBytes = std::uint64_t{1} << 26;
  constexpr std::uint8_t kStored = 0;
  const std::uint64_t name_size = reader.varint();
  const Bytes name = reader.bytes(name_size);
  const std::uint8_t encoding = reader.u8();
  const std::uint64_t decoded_size = reader.varint();
  if (!reader.ok()) return {kSection, "the data chunk is too short"};
  const std::string_view text(reinterpret_cast<const char*>(name.data()), name.size());
  if (text.empty() || text.size() > kMostNameBytes || !is_metadata_text(text))
    return {kSection, "the name of data is empty, too long or no text in UTF-8"};
  if (decoded_size > kMostDecodedBytes)
    return {kSection, "data are larger than a stream may hold", ErrorCode::kLimitExceeded};
  if (reader.left() > decoded_size || (encoding == kStored && reader.left() != decoded_size))
    return {kSection, "data do not have the size they are said to have"};
  return {};
}

}  // namespace

Status check_data(Bytes payload) {
  const Fault fault = fault_in(ByteReader(payload));
  return fault ? Status(error_of(fault)) : Status();
}

}  // namespace tvg
