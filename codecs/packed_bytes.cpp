#include "codecs/packed_bytes.hpp"

#include <stdexcept>
#include <string>
#include <zstd.h>

namespace tvg::bench {

void require(bool success, const char* what) {
  if (!success) throw std::runtime_error(std::string(what) + " failed");
}

Bytes zstd_compress(std::span<const unsigned char> bytes) {
  Bytes packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 19);
  require(ZSTD_isError(size) == 0, "ZSTD_compress");
  packed.resize(size);
  return packed;
}

void zstd_decompress(const Bytes& packed, Bytes& bytes) {
  const std::size_t size = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
  require(size == bytes.size(), "ZSTD_decompress");
}

}  // namespace tvg::bench
