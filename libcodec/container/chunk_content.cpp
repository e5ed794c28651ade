#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "container/chunk_reader.hpp"
#include "container/data_payload.hpp"
#include "container/head.hpp"
#include "container/metadata.hpp"

#include <algorithm>
#include <utility>

// What the reader makes of the content of chunks other than GOPs.
namespace tvg {

namespace {

/// Of planes that add to what is not there.
constexpr std::uint32_t kUnknownPart = 1u << 16;

}  // namespace

std::optional<ChunkReader::Event> ChunkReader::use_payload(Bytes payload) {
  switch (kind_) {
    case ChunkKind::kHead:
      return use_head(payload);
    case ChunkKind::kMetadata: {
      Result<Metadata> metadata = read_metadata(payload);
      if (!metadata) return report(std::move(metadata.error()));
      metadata_ = std::move(*metadata);
      return Event::kMetadata;
    }
    case ChunkKind::kData: {
      const Fault fault = read_data(payload, data_);
      return fault ? report(error_of(fault)) : Event::kData;
    }
    case ChunkKind::kMesh:
      return use_mesh(payload);
    case ChunkKind::kPlan:
      return use_plan(payload);
    case ChunkKind::kIndex:
      return use_index(payload);
    default:
      return use_tail(payload);
  }
}

// format-spec §4.1, §8.1
ChunkReader::Event ChunkReader::use_head(Bytes payload) {
  Result<StreamHead> head = read_head(payload);
  if (!head) {
    head.error().byte_offset = chunk_offset_;
    return fail(std::move(head.error()));
  }
  if (Status status = check_declared(head->limits, caller_limits_); !status.ok()) {
    Error error = status.error();
    error.byte_offset = chunk_offset_;
    return fail(std::move(error));
  }
  head_ = *head;
  state_ = StreamState::kOpen;
  return Event::kHead;
}

// format-spec §4.3
std::optional<ChunkReader::Event> ChunkReader::use_mesh(Bytes payload) {
  Result<MeshLayout> mesh = read_mesh(payload);
  Status status = mesh ? check_mesh_size(*mesh, head_.limits) : Status(std::move(mesh.error()));
  if (status.ok()) {
    mesh_ = *mesh;
    return note_mesh(mesh_.vertex_count, {}) ? Event::kMesh : fail(out_of_memory());
  }
  if (!note_mesh(0, status.error().code)) return fail(out_of_memory());
  if (status.error().code == ErrorCode::kUnsupported) {  // a GOP that names it will tell
    consume(std::exchange(used_, std::size_t{0}));
    return std::nullopt;
  }
  Error error = status.error();
  error.byte_offset = chunk_offset_;
  return lose(std::move(error), used_);
}

/// A mesh takes its place among those in force; what is known of it stays where it is there already.
bool ChunkReader::note_mesh(std::uint32_t vertex_count, std::optional<ErrorCode> fault) {
  ChunkWindow::Entry mesh{.id = payload_checksum_, .fault = fault, .number = vertex_count};
  if (const ChunkWindow::Entry* const known = meshes_.find(payload_checksum_)) mesh = *known;
  mesh.offset = chunk_offset_;
  expected_index_.add({.offset = chunk_offset_, .kind = IndexEntry::Kind::kMesh});
  return meshes_.put(std::move(mesh), head_.limits.meshes);
}

/// Passes over planes that add to more others than are wanted.
// format-spec §4.9
std::optional<ChunkReader::Event> ChunkReader::look_at_planes() {
  const std::size_t size = std::min<std::size_t>(chunk_.length, kPlanHeaderBytes);
  if (available().size() < size) return need_bytes();
  phase_ = Phase::kPayload;
  if (read_plan(available().first(size), plan_) || plan_.adds_to == 0) return std::nullopt;
  const ChunkWindow::Entry* const mesh = meshes_.find(plan_.mesh);
  if (mesh == nullptr || mesh->parts_wanted == 0) return std::nullopt;
  // What it adds to may have been passed over unseen.
  const ChunkWindow::Entry* const base = base_of_planes(*mesh);
  if (base != nullptr && base->part + 1 < mesh->parts_wanted) return std::nullopt;
  unwanted_ = true;
  phase_ = Phase::kPassOver;
  return std::nullopt;
}

// format-spec §4.9
std::optional<ChunkReader::Event> ChunkReader::use_plan(Bytes payload) {
  Fault fault = read_plan(payload, plan_);
  const std::uint64_t owner = fault ? 0 : owner_of_planes(plan_.mesh, plan_.mode);
  const ChunkWindow::Entry* const mesh = fault ? nullptr : meshes_.find(plan_.mesh);
  if (!fault && mesh == nullptr)
    fault = {state_ == StreamState::kOpen ? "§3.4" : "§4.9", "the mesh of planes is not in force"};
  const bool adds = !fault && plan_.adds_to != 0;
  const ChunkWindow::Entry* const base = adds ? base_of_planes(*mesh) : nullptr;
  if (adds && (base == nullptr || (base->number != 0 && base->number != owner)))
    fault = {"§4.9", "planes add to others that are not in force, or not theirs"};
  std::optional<ErrorCode> unusable;
  if (fault) {
    unusable = fault.code;
  } else if (mesh->fault) {
    unusable = mesh->fault;
  } else if (!is_known_mode(plan_.mode)) {
    unusable = ErrorCode::kUnsupported;
  } else if (base != nullptr) {
    unusable = base->fault;
  }
  if (!note_plan(owner, unusable)) return fail(out_of_memory());
  if (!unusable) return Event::kPlan;
  // Where something was passed over, the mesh may have been, too, or what the planes add to.
  const bool passed_over = owner != 0 && (mesh == nullptr || (adds && base == nullptr)) && !whole_;
  if (fault && !passed_over) return report(error_of(fault));
  consume(std::exchange(used_, std::size_t{0}));  // a GOP that names it will tell
  return std::nullopt;
}

/// What the planes add to whose header was read, of this mesh; null where that is not in force.
const ChunkWindow::Entry* ChunkReader::base_of_planes(const ChunkWindow::Entry& mesh) const {
  const auto* const base = plans_.find(static_cast<std::uint32_t>(plan_.adds_to - 1));
  return base == nullptr || base->offset < mesh.offset ? nullptr : base;
}

/// Planes take their place among those in force; what was made of them stays where they are there already.
bool ChunkReader::note_plan(std::uint64_t owner, std::optional<ErrorCode> fault) {
  ChunkWindow::Entry plan{.id = payload_checksum_, .fault = fault, .offset = chunk_offset_, .number = owner};
  if (owner != 0 && plan_.adds_to != 0) {
    const auto* const base = plans_.find(static_cast<std::uint32_t>(plan_.adds_to - 1));
    plan.adds_to = plan_.adds_to;
    plan.part = base == nullptr ? kUnknownPart : std::min(base->part, kUnknownPart - 1) + 1;
  }
  const ChunkWindow::Entry* const known = plans_.find(payload_checksum_);
  if (known != nullptr && !known->fault && !fault) plan.content = known->content;
  expected_index_.add({.offset = chunk_offset_, .kind = IndexEntry::Kind::kPlan});
  return plans_.put(std::move(plan), head_.limits.plans);
}

// format-spec §4.6
ChunkReader::Event ChunkReader::use_index(Bytes payload) {
  Result<Index> index = read_index(payload, chunk_offset_);
  if (!index) return report(std::move(index.error()));
  index_ = std::move(index->entries);
  index_matches_ = !whole_ || index->digest == expected_index_;
  return Event::kIndex;
}

// format-spec §4.7
std::optional<ChunkReader::Event> ChunkReader::use_tail(Bytes payload) {
  phase_ = Phase::kTail;
  state_ = StreamState::kEnded;
  Result<std::uint64_t> distance = read_tail(payload);
  if (!distance) return report(std::move(distance.error()));
  if (whole_ && index_offset_ && *distance != chunk_offset_ - *index_offset_)
    return report(malformed("§4.7", "the tail does not lead to the index"));
  consume(std::exchange(used_, std::size_t{0}));
  return std::nullopt;
}

}  // namespace tvg
