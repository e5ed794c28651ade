#include "base/stream_error.hpp"
#include "container/data_payload.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <zstd.h>

namespace tvg {

namespace {

/// What is large is most often an image or numbers, which do not get smaller for all the time in the world.
constexpr std::size_t kLarge = std::size_t{1} << 22;
constexpr int kSmallestLevel = 19;
constexpr int kFasterLevel = 9;

/// Skippable frames and those of versions before zstd's first begin otherwise.
constexpr std::array<std::uint8_t, 4> kFrameMagic = {0x28, 0xB5, 0x2F, 0xFD};

/// Empty where it would not be smaller.
std::vector<std::uint8_t> compressed(Bytes bytes) {
  std::vector<std::uint8_t> packed(bytes.size());
  const int level = bytes.size() < kLarge ? kSmallestLevel : kFasterLevel;
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), level);
  packed.resize(ZSTD_isError(size) != 0 || size >= bytes.size() ? 0 : size);
  return packed;
}

Status decompress(Bytes packed, std::vector<std::uint8_t>& bytes) {
  const bool begins = packed.size() >= kFrameMagic.size() &&
                      std::equal(kFrameMagic.begin(), kFrameMagic.end(), packed.begin());
  if (!begins || ZSTD_findFrameCompressedSize(packed.data(), packed.size()) != packed.size())
    return malformed("§4.8", "compressed data are not exactly one frame of zstd");
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  if (context == nullptr) return out_of_memory();
  const std::size_t size =
      ZSTD_decompressDCtx(context.get(), bytes.data(), bytes.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) != 0 || size != bytes.size())
    return malformed("§4.8", "compressed data are damaged, or not of the size they are said to have");
  return {};
}

}  // namespace

std::vector<std::uint8_t> write_data(const NamedData& data) {
  const std::vector<std::uint8_t> packed = compressed(data.bytes);
  ByteWriter writer;
  writer.varint(data.name.size());
  writer.bytes({reinterpret_cast<const std::uint8_t*>(data.name.data()), data.name.size()});
  writer.u8(static_cast<std::uint8_t>(packed.empty() ? DataEncoding::kStored : DataEncoding::kZstd));
  writer.varint(data.bytes.size());
  writer.bytes(packed.empty() ? Bytes(data.bytes) : Bytes(packed));
  return writer.take();
}

// format-spec §4.8
Result<NamedData> unpack_data(const CodedData& data) {
  if (data.decoded_size > kMaxDataBytes)
    return stream_error(ErrorCode::kLimitExceeded, "§4.8", {"data are larger than a stream may hold"});
  try {
    NamedData unpacked{std::string(data.name), {}};
    if (data.encoding == DataEncoding::kStored) {
      if (data.bytes.size() != data.decoded_size)
        return malformed("§4.8", "data do not have the size they are said to have");
      unpacked.bytes.assign(data.bytes.begin(), data.bytes.end());
    } else if (data.encoding == DataEncoding::kZstd) {
      unpacked.bytes.resize(static_cast<std::size_t>(data.decoded_size));
      if (Status status = decompress(data.bytes, unpacked.bytes); !status.ok()) return status.error();
    } else {
      return stream_error(ErrorCode::kUnsupported, "§4.8", {"data are encoded in a way that is not known"});
    }
    return unpacked;
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace tvg
