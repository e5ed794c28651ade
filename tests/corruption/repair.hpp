#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Takes streams apart without trusting them, so that damage can be put where a checksum would hide it.
namespace tvg::corruption {

/// Where a structure lies in a stream.
struct Extent {
  std::size_t begin = 0, size = 0;

  std::size_t end() const { return begin + size; }
};

/// A chunk whose header and payload lie within the stream.
struct ChunkExtent {
  char type = 0;                ///< its first letter
  Extent whole;                 ///< header, payload, checksum
  std::vector<Extent> packets;  ///< of a GOP: size, bytes and checksum each
};

/// The chunks from the signature on, as far as their lengths lead; checksums are not looked at.
std::vector<ChunkExtent> find_chunks(std::span<const std::uint8_t> stream);

/// Makes every chunk's length reach to the next place where a known chunk type is written, or to the end.
void repair_lengths(std::span<std::uint8_t> stream);

/// Makes every checksum fit its bytes, in chunk headers, packets and chunks. Digests stay as they are.
void repair_checksums(std::span<std::uint8_t> stream);

}  // namespace tvg::corruption
