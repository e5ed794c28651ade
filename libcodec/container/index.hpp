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

/// The entries of an index, as a digest: a live stream may run for days, and a list would grow.
class IndexDigest {
 public:
  void add(const IndexEntry& entry);
  std::uint64_t count() const { return count_; }
  bool operator==(const IndexDigest& other) const {
    return count_ == other.count_ && hash_.value() == other.hash_.value();
  }

 private:
  Hasher hash_;
  std::uint64_t count_ = 0;
};

std::vector<std::uint8_t> write_index(const std::vector<IndexEntry>& entries);

/// An index as it was read.
struct Index {
  std::vector<IndexEntry> entries;  ///< those of known kinds
  IndexDigest digest;               ///< of these
};
/// An index that stands at `offset` of its stream: all entries lie before it.
Result<Index> read_index(Bytes payload, std::uint64_t offset = ~std::uint64_t{0});

/// The longest payload of an index with so many meshes, planes and GOPs.
std::uint64_t most_index_bytes(std::uint64_t entries);

/// Distance in bytes from the start of the tail chunk back to the start of the index chunk.
std::vector<std::uint8_t> write_tail(std::uint64_t index_distance);
Result<std::uint64_t> read_tail(Bytes payload);

}  // namespace tvg
