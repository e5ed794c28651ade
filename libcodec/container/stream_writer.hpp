#pragma once
#include "container/chunk.hpp"
#include "container/head.hpp"
#include "container/index.hpp"
#include "container/metadata.hpp"

#include <cstdint>
#include <functional>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Writes a stream's structures in their order and keeps the index (format-spec §3.4).
class StreamWriter {
 public:
  explicit StreamWriter(std::function<Status(Bytes)> sink) : sink_(std::move(sink)) {}

  Status write(Bytes bytes) {
    offset_ += bytes.size();
    return sink_(bytes);
  }
  /// Signature, head and, where there are any, metadata.
  Status write_start(const StreamLimits& limits, const Metadata& metadata) {
    if (Status status = write(kSignature); !status.ok()) return status;
    if (Status status = write(write_chunk(kHeadChunk, false, write_head(limits))); !status.ok())
      return status;
    if (metadata.empty()) return {};
    return write(write_chunk(kMetadataChunk, true, write_metadata(metadata)));
  }
  Status write_mesh_chunk(Bytes chunk) {
    index_.push_back({IndexEntry::Kind::kMesh, offset_, 0});
    return write(chunk);
  }
  Status write_gop_chunk(Bytes chunk, std::uint32_t frame_count) {
    index_.push_back({IndexEntry::Kind::kGop, offset_, frame_count});
    return write(chunk);
  }
  Status write_end() {
    const std::vector<std::uint8_t> index = write_chunk(kIndexChunk, true, write_index(index_));
    if (Status status = write(index); !status.ok()) return status;
    return write(write_chunk(kTailChunk, false, write_tail(index.size())));
  }

  std::uint64_t offset() const { return offset_; }

 private:
  std::function<Status(Bytes)> sink_;
  std::uint64_t offset_ = 0;
  std::vector<IndexEntry> index_;
};

}  // namespace tvg
