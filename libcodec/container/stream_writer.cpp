#include "container/stream_writer.hpp"

#include "base/checksum.hpp"
#include "base/stream_error.hpp"
#include "container/chunk.hpp"
#include "container/data_payload.hpp"
#include "container/head.hpp"
#include "container/index.hpp"
#include "container/metadata.hpp"
#include "container/packet.hpp"
#include "container/plan_payload.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace tvg {

namespace {

Error not_in_force(const char* what, const char* section) {
  return Error{ErrorCode::kInvalidArgument, std::string(what) + " not in force", {}, {}, section};
}

std::uint64_t hash_of(Bytes chunk) {
  Hasher hash;
  hash.update(chunk);
  return hash.value();
}

}  // namespace

std::uint32_t chunk_id(Bytes chunk) {
  return ByteReader(chunk.last(std::min(chunk.size(), kChunkChecksumSize))).u32();
}

std::optional<GopHeader> header_of_gop(Bytes gop_chunk) {
  ByteReader reader(gop_chunk);
  reader.bytes(kChunkHeaderSize);
  const std::uint8_t kind = reader.u8();
  const Bytes packet = reader.bytes(reader.varint());
  if (!reader.ok() || kind != packet_kind::kHeader) return std::nullopt;
  const Result<GopHeader> header = read_gop_header(packet);
  return header ? std::optional(*header) : std::nullopt;
}

std::vector<std::uint32_t> plane_ids(const GopHeader& header) {
  std::vector<std::uint32_t> ids(header.plane_count());
  ByteReader reader(header.planes);
  for (std::uint32_t& id : ids) id = reader.u32();
  return ids;
}

Status StreamWriter::write(Bytes bytes) {
  offset_ += bytes.size();
  return sink_(bytes);
}

Status StreamWriter::write_start(const StreamLimits& limits, const Metadata& metadata,
                                 std::span<const NamedData> data) {
  limits_ = limits;
  if (Status status = write(kSignature); !status.ok()) return status;
  if (Status status = write(write_chunk(kHeadChunk, false, write_head(limits))); !status.ok()) return status;
  if (!metadata.empty()) {
    if (Status status = write(write_chunk(kMetadataChunk, true, write_metadata(metadata))); !status.ok())
      return status;
  }
  for (const NamedData& one : data) {
    if (Status status = write(write_chunk(kDataChunk, true, write_data(one))); !status.ok()) return status;
  }
  return {};
}

Status StreamWriter::write_mesh_chunk(Bytes chunk, bool renew) {
  const std::uint32_t id = chunk_id(chunk);
  const std::uint64_t hash = hash_of(chunk);
  if (const auto* const known = meshes_.find(id)) {
    if (known->number != hash) {
      return Error{ErrorCode::kInvalidInput,
                   "two different meshes have the same checksum, by which a stream names them",
                   {},
                   {},
                   "§4.3"};
    }
    if (!renew || meshes_.back(*known) == 1) return {};
  }
  if (!meshes_.put({.id = id, .offset = offset_, .number = hash}, limits_.meshes)) return out_of_memory();
  index_.push_back({.offset = offset_, .kind = IndexEntry::Kind::kMesh});
  return write(chunk);
}

Status StreamWriter::write_plan_chunk(Bytes chunk, bool renew) {
  PlanHeader plan;
  const bool whole = chunk.size() >= kLeastChunkSize;
  const Bytes payload = whole ? chunk.subspan(kChunkHeaderSize, chunk.size() - kLeastChunkSize) : Bytes();
  if (const Fault fault = read_plan(payload, plan)) return error_of(fault);
  const auto* const mesh = meshes_.find(plan.mesh);
  if (mesh == nullptr) return not_in_force("the mesh of planes is", "§4.9");
  const std::uint32_t id = chunk_id(chunk);
  const std::uint64_t hash = hash_of(chunk);
  if (const auto* const known = plans_.find(id); known != nullptr && known->offset > mesh->offset) {
    if (known->number != hash) {
      return Error{ErrorCode::kInvalidInput,
                   "two different chunks of planes have the same checksum, by which a stream names them",
                   {},
                   {},
                   "§4.9"};
    }
    if (!renew || plans_.back(*known) == 1) return {};
  }
  if (!plans_.put({.id = id, .offset = offset_, .number = hash}, limits_.plans)) return out_of_memory();
  index_.push_back({.offset = offset_, .kind = IndexEntry::Kind::kPlan});
  return write(chunk);
}

Status StreamWriter::write_gop_chunk(Bytes chunk, std::uint32_t frame_count) {
  const std::optional<GopHeader> header = header_of_gop(chunk);
  const auto* const mesh = header ? meshes_.find(header->mesh) : nullptr;
  if (mesh == nullptr) return not_in_force("the mesh of a GOP is", "§4.5.1");
  std::vector<std::uint64_t> planes_back;
  for (const std::uint32_t id : plane_ids(*header)) {
    const auto* const plan = plans_.find(id);
    if (plan == nullptr || plan->offset < mesh->offset) return not_in_force("planes of a GOP are", "§4.5.1");
    planes_back.push_back(plans_.back(*plan));
  }
  std::optional<PlaneList> planes = PlaneList::of(planes_back);
  if (!planes) return out_of_memory();
  index_.push_back({.offset = offset_,
                    .frame_count = frame_count,
                    .meshes_back = static_cast<std::uint32_t>(meshes_.back(*mesh)),
                    .kind = IndexEntry::Kind::kGop,
                    .planes_back = *std::move(planes)});
  return write(chunk);
}

Status StreamWriter::write_end() {
  const std::vector<std::uint8_t> index = write_chunk(kIndexChunk, true, write_index(index_));
  if (Status status = write(index); !status.ok()) return status;
  return write(write_chunk(kTailChunk, false, write_tail(index.size())));
}

}  // namespace tvg
