#pragma once
#include "base/byte_io.hpp"
#include "container/chunk_window.hpp"
#include "container/gop_header.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// The name of a mesh or of planes (format-spec §4.3, §4.9): the payload checksum of their whole chunk.
std::uint32_t chunk_id(Bytes chunk);
/// The header of a GOP, from its chunk as far as the end of the header packet; nothing where that is no GOP.
/// Its parts lie in the bytes given.
std::optional<GopHeader> header_of_gop(Bytes gop_chunk);

/// The names of the planes that a GOP names.
std::vector<std::uint32_t> plane_ids(const GopHeader& header);

/// Writes a stream's structures in their order and keeps the index (format-spec §3.4).
class StreamWriter {
 public:
  explicit StreamWriter(std::function<Status(Bytes)> sink) : sink_(std::move(sink)) {}

  Status write(Bytes bytes);
  /// Signature, head and, where there are any, metadata and free-form data.
  Status write_start(const StreamLimits& limits, const Metadata& metadata,
                     std::span<const NamedData> data = {});
  /// Writes a mesh unless it is in force already; `chunk` is all of its chunk. kInvalidInput where another
  /// mesh of the same name is in force. With `renew` one that is in force is written all the same where
  /// others came after it, and so stays in force as long as a new one would.
  Status write_mesh_chunk(Bytes chunk, bool renew = false);
  /// Writes planes unless they are in force already; `chunk` is all of their chunk. kInvalidInput where
  /// others of the same name are in force, kInvalidArgument where their mesh is not.
  Status write_plan_chunk(Bytes chunk, bool renew = false);
  /// `chunk` reaches at least to the end of the header packet; write() takes the rest. kInvalidArgument where
  /// the mesh or planes that it names are not in force.
  Status write_gop_chunk(Bytes chunk, std::uint32_t frame_count);
  /// Index and tail.
  Status write_end();

  std::uint64_t offset() const { return offset_; }
  /// Whether the mesh of this id may be named by what is written next.
  bool mesh_in_force(std::uint32_t id) const { return meshes_.find(id) != nullptr; }
  /// Mesh chunks written.
  std::uint64_t meshes() const { return meshes_.count(); }

 private:
  std::function<Status(Bytes)> sink_;
  std::uint64_t offset_ = 0;
  std::vector<IndexEntry> index_;
  StreamLimits limits_;
  // `number` is the chunk's hash, which tells chunks of one name apart.
  ChunkWindow meshes_;
  ChunkWindow plans_;
};

}  // namespace tvg
