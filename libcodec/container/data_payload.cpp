#include "container/data_payload.hpp"

namespace tvg {

// format-spec §4.8
Fault read_data(Bytes payload, CodedData& data) {
  constexpr const char* kSection = "§4.8";
  ByteReader reader(payload);
  const std::uint64_t name_size = reader.varint();
  const Bytes name = reader.bytes(name_size);
  data.encoding = static_cast<DataEncoding>(reader.u8());
  data.decoded_size = reader.varint();
  if (!reader.ok()) return {kSection, "the data chunk is too short"};
  data.name = {reinterpret_cast<const char*>(name.data()), name.size()};
  if (data.name.empty() || data.name.size() > kMaxDataNameBytes || !is_metadata_text(data.name))
    return {kSection, "the name of data is empty, too long or no text in UTF-8"};
  if (data.decoded_size > kMaxDataBytes)
    return {kSection, "data are larger than a stream may hold", ErrorCode::kLimitExceeded};
  const bool stored = data.encoding == DataEncoding::kStored;
  if (reader.left() > data.decoded_size || (stored && reader.left() != data.decoded_size))
    return {kSection, "data do not have the size they are said to have"};
  data.bytes = reader.bytes(reader.left());
  return {};
}

}  // namespace tvg
