#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// How free-form data are encoded. The numbers are those of the format (§4.8); a stream may have others.
enum class DataEncoding : std::uint8_t {
  kStored = 0,
  kZstd = 1,  ///< one frame of zstd (RFC 8878)
};

inline constexpr std::uint64_t kMaxDataNameBytes = 1024;
inline constexpr std::uint64_t kMaxDataBytes = std::uint64_t{1} << 26;

/// Free-form data as they stand in a stream. Name and bytes lie in the stream's own.
struct CodedData {
  std::string_view name;  ///< 1 to kMaxDataNameBytes, as is_metadata_text()
  DataEncoding encoding = DataEncoding::kStored;
  std::uint64_t decoded_size = 0;       ///< at most kMaxDataBytes
  std::span<const std::uint8_t> bytes;  ///< as they are encoded, at most decoded_size
};

/// Undoes the encoding, which takes at most decoded_size bytes of memory beside the decompressor's own.
/// kMalformed where the bytes are not exactly decoded_size bytes so encoded, kUnsupported for an encoding
/// that is not known here, kLimitExceeded above kMaxDataBytes, kOutOfMemory. It is part of the encoding half,
/// which has zstd at hand: who has the decoder alone undoes the encoding by a decompressor of its own.
Result<NamedData> unpack_data(const CodedData& data);

}  // namespace tvg
