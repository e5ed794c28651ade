#include "container/stream_writer.hpp"

#include "base/checksum.hpp"
#include "base/stream_error.hpp"
#include "container/chunk.hpp"
#include "container/head.hpp"
#include "container/index.hpp"
#include "container/metadata.hpp"
#include "container/packet.hpp"

namespace tvg {

std::uint32_t mesh_id(Bytes mesh_chunk) {
  return ByteReader(mesh_chunk.last(std::min(mesh_chunk.size(), kChunkChecksumSize))).u32();
}

std::optional<std::uint32_t> mesh_of_gop(Bytes gop_chunk) {
  ByteReader reader(gop_chunk);
  reader.bytes(kChunkHeaderSize);
  const std::uint8_t kind = reader.u8();
  reader.varint();  // the size of the header packet
  const std::uint32_t mesh = reader.u32();
  return reader.ok() && kind == packet_kind::kHeader ? std::optional(mesh) : std::nullopt;
}

Status StreamWriter::write(Bytes bytes) {
  offset_ += bytes.size();
  return sink_(bytes);
}

Status StreamWriter::write_start(const StreamLimits& limits, const Metadata& metadata) {
  meshes_in_force_ = limits.meshes;
  if (Status status = write(kSignature); !status.ok()) return status;
  if (Status status = write(write_chunk(kHeadChunk, false, write_head(limits))); !status.ok()) return status;
  if (metadata.empty()) return {};
  return write(write_chunk(kMetadataChunk, true, write_metadata(metadata)));
}

Status StreamWriter::write_mesh_chunk(Bytes chunk) {
  Hasher hash;
  hash.update(chunk);
  const std::uint32_t id = mesh_id(chunk);
  if (const auto* const known = meshes_.find(id)) {
    if (known->number == hash.value()) return {};
    return Error{ErrorCode::kInvalidInput,
                 "two different meshes have the same checksum, by which a stream names them",
                 {},
                 {},
                 "§4.3"};
  }
  if (!meshes_.put({.id = id, .offset = offset_, .number = hash.value()}, meshes_in_force_))
    return out_of_memory();
  index_.push_back({.offset = offset_, .kind = IndexEntry::Kind::kMesh});
  return write(chunk);
}

Status StreamWriter::write_gop_chunk(Bytes chunk, std::uint32_t frame_count) {
  const std::optional<std::uint32_t> id = mesh_of_gop(chunk);
  const auto* const mesh = id ? meshes_.find(*id) : nullptr;
  if (mesh == nullptr)
    return Error{ErrorCode::kInvalidArgument, "the mesh of a GOP is not in force", {}, {}, "§4.5.1"};
  index_.push_back({.offset = offset_,
                    .frame_count = frame_count,
                    .meshes_back = static_cast<std::uint32_t>(meshes_.back(*mesh)),
                    .kind = IndexEntry::Kind::kGop});
  return write(chunk);
}

Status StreamWriter::write_end() {
  const std::vector<std::uint8_t> index = write_chunk(kIndexChunk, true, write_index(index_));
  if (Status status = write(index); !status.ok()) return status;
  return write(write_chunk(kTailChunk, false, write_tail(index.size())));
}

}  // namespace tvg
