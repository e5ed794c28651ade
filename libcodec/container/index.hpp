#pragma once
#include "base/byte_io.hpp"
#include "base/checksum.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/stream_map.hpp>
#include <tvg/types.hpp>

// The index and the tail that leads to it (format-spec §4.6, §4.7).
namespace tvg {

std::vector<std::uint8_t> write_index(const std::vector<IndexEntry>& entries);
/// The entries of an index that stands at `offset` of its stream: all lie before it, and no two nearer to
/// each other than a chunk is long, which bounds their number.
Result<std::vector<IndexEntry>> read_index(Bytes payload, std::uint64_t offset = ~std::uint64_t{0});

/// The longest payload an index at `offset` of a stream can have.
std::uint64_t most_index_bytes(std::uint64_t offset);

/// Distance in bytes from the start of the tail chunk back to the start of the index chunk.
std::vector<std::uint8_t> write_tail(std::uint64_t index_distance);
Result<std::uint64_t> read_tail(Bytes payload);

/// The index that the meshes and GOPs met should have, as a digest: a live stream may run for days, and a
/// list would grow.
class ExpectedIndex {
 public:
  /// Takes note of a mesh (no frames) or GOP; one that lies before the last is known already.
  void add(std::uint64_t offset, std::uint32_t frame_count);
  bool matches(Bytes payload) const;

 private:
  Hasher digest_;
  std::uint64_t count_ = 0;
  std::uint64_t last_offset_ = 0;
};

}  // namespace tvg
