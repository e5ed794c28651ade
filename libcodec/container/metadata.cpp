#include "container/metadata.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace tvg {

std::vector<std::uint8_t> write_metadata(const Metadata& metadata) {
  ByteWriter writer;
  writer.varint(metadata.size());
  for (const auto& [key, value] : metadata) {
    for (const std::string& text : {key, value}) {
      writer.varint(text.size());
      writer.bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }
  }
  return writer.take();
}

// format-spec §4.2
Result<Metadata> read_metadata(Bytes payload) {
  ByteReader reader(payload);
  const std::uint64_t count = reader.varint();
  if (count > reader.left() / 2) return malformed("§4.2", "more metadata entries than bytes can hold");
  // A node of the map for each entry, and its strings, which round their sizes up.
  constexpr std::size_t kEntryBytes = sizeof(Metadata::value_type) + 4 * sizeof(void*) + 64;
  if (!can_allocate(static_cast<std::size_t>(count) * kEntryBytes + 4 * payload.size() + kSmallThings))
    return out_of_memory();
  const auto text = [&reader] {
    const Bytes bytes = reader.bytes(reader.varint());
    return std::string(bytes.begin(), bytes.end());
  };
  Metadata metadata;
  for (std::uint64_t i = 0; i < count && reader.ok(); ++i) {
    std::string key = text();
    std::string value = text();
    if (key.empty() || (!metadata.empty() && key <= metadata.rbegin()->first)) {
      return malformed("§4.2", "metadata keys are empty or not in ascending order");
    }
    if (!is_metadata_text(key) || !is_metadata_text(value)) {
      return malformed("§4.2", "metadata are not text in UTF-8");
    }
    metadata.emplace_hint(metadata.end(), std::move(key), std::move(value));
  }
  if (!reader.finished()) return malformed("§4.2", "metadata entries do not fill the chunk exactly");
  return metadata;
}

bool is_metadata_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    if (lead == 0) return false;
    if (lead < 0x80) continue;
    const std::size_t more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
    if (lead < 0xc2 || lead > 0xf4 || more > text.size() - i) return false;
    const auto second = static_cast<unsigned char>(text[i]);
    // Over-long forms, surrogates and numbers above 10FFFF show in the second byte.
    if (lead == 0xe0 && second < 0xa0) return false;
    if (lead == 0xed && second > 0x9f) return false;
    if (lead == 0xf0 && second < 0x90) return false;
    if (lead == 0xf4 && second > 0x8f) return false;
    for (std::size_t k = 0; k < more; ++k, ++i) {
      if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return false;
    }
  }
  return true;
}

}  // namespace tvg
