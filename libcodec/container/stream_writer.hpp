#pragma once
#include "base/byte_io.hpp"
#include "container/chunk_window.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// The name of a mesh (format-spec §4.3): the payload checksum of its whole chunk.
std::uint32_t mesh_id(Bytes mesh_chunk);
/// The mesh that a GOP names, from its chunk as far as the end of the header packet; nothing where that is no
/// GOP.
std::optional<std::uint32_t> mesh_of_gop(Bytes gop_chunk);

/// Writes a stream's structures in their order and keeps the index (format-spec §3.4).
class StreamWriter {
 public:
  explicit StreamWriter(std::function<Status(Bytes)> sink) : sink_(std::move(sink)) {}

  Status write(Bytes bytes);
  /// Signature, head and, where there are any, metadata.
  Status write_start(const StreamLimits& limits, const Metadata& metadata);
  /// Writes a mesh unless it is in force already; `chunk` is all of its chunk. kInvalidInput where another
  /// mesh of the same name is in force.
  Status write_mesh_chunk(Bytes chunk);
  /// `chunk` reaches at least to the end of the header packet; write() takes the rest. kInvalidArgument where
  /// the mesh it names is not in force.
  Status write_gop_chunk(Bytes chunk, std::uint32_t frame_count);
  /// Index and tail.
  Status write_end();

  std::uint64_t offset() const { return offset_; }
  /// Mesh chunks written.
  std::uint64_t meshes() const { return meshes_.count(); }

 private:
  std::function<Status(Bytes)> sink_;
  std::uint64_t offset_ = 0;
  std::vector<IndexEntry> index_;
  std::uint32_t meshes_in_force_ = 1;
  ChunkWindow meshes_;  ///< `number` is the payload's hash, which tells meshes of one name apart
};

}  // namespace tvg
