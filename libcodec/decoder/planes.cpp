#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "decoder/decoder_state.hpp"

#include <array>
#include <span>
#include <utility>

// The planes that GOPs share: what is made of their chunks, and which of them a GOP needs.
namespace tvg {

/// Planes that cannot be used lose no frame by themselves: the GOPs that name them do.
// format-spec §4.9
std::optional<Decoder::Event> Decoder::State::take_plan() {
  if (!map_.note({{.offset = reader.chunk_offset(), .kind = IndexEntry::Kind::kPlan}, frames_.position()})) {
    reader.fail(out_of_memory());
    return std::nullopt;
  }
  if (plan_in_force(reader.plan_id()) != nullptr) return std::nullopt;
  const std::size_t part = reader.plans().find(reader.plan_id())->part;
  Result<PlanPart> decoded = decode_plan_read(mesh_in_force(reader.plan().mesh)->coded, part);
  if (decoded && can_allocate(kSmallThings)) {
    reader.keep(std::make_shared<const PlanPart>(std::move(*decoded)));
    return std::nullopt;
  }
  Error cause = decoded ? out_of_memory() : std::move(decoded.error());
  cause.byte_offset = reader.chunk_offset();
  if (cause.code == ErrorCode::kOutOfMemory) {
    reader.fail(std::move(cause));
    return std::nullopt;
  }
  reader.reject(cause.code);
  return tell(frames_.lose(0, std::move(cause)));
}

/// What is kept of the planes whose chunk was just read: the bytes of a part until the last that is wanted is
/// there, and then the basis.
// format-spec §7.8.1
Result<PlanPart> Decoder::State::decode_plan_read(const CodedMesh& coded, std::size_t part) {
  const Bytes fields = reader.plan().fields;
  const std::size_t wanted = coded.parts_wanted();
  if (part >= coded.parts()) return malformed("§7.8.1", "planes of a basis add to all of its parts");
  PlanPart result;
  if (part > 0) result.before = plan_in_force(static_cast<std::uint32_t>(reader.plan().adds_to - 1));
  if (part + 1 > wanted) return result;
  if (part + 1 < wanted) {
    if (!try_reserve(result.fields, fields.size())) return out_of_memory();
    result.fields.assign(fields.begin(), fields.end());
    return result;
  }
  std::array<Bytes, kMaxCoarseMeshes + 1> parts;
  parts[part] = fields;
  const PlanPart* before = result.before.get();
  for (std::size_t i = part; i-- > 0; before = before->before.get()) {
    // What went out of force as this came cannot be named beside it.
    if (before == nullptr) return result;
    parts[i] = before->fields;
  }
  Result<BasisPlan> plan =
      decode_basis_plan(std::span(parts).first(wanted), mesh_in_force(reader.plan().mesh),
                        reader.head().limits, most_components);
  if (!plan) return plan.error();
  if (!can_allocate(kSmallThings)) return out_of_memory();
  plan->number = ++plans_made_;
  result.plan = std::make_shared<const BasisPlan>(std::move(*plan));
  return result;
}

/// Planes as they were decoded; null where none of this name are in force.
std::shared_ptr<const PlanPart> Decoder::State::plan_in_force(std::uint32_t id) const {
  const ChunkWindow::Entry* const entry = reader.plans().find(id);
  return entry == nullptr ? nullptr : std::static_pointer_cast<const PlanPart>(entry->content);
}

/// The basis that the GOP names which is being read; null where it does not name the parts of one, in order.
// format-spec §4.5.1
std::shared_ptr<const BasisPlan> Decoder::State::plan_of_gop() const {
  const GopHeader& header = reader.gop();
  const std::shared_ptr<const GopMesh> its_mesh = mesh_in_force(header.mesh);
  if (its_mesh == nullptr || header.plane_count() != its_mesh->coded.parts()) return nullptr;
  std::uint64_t before = 0;
  ByteReader ids(header.planes);
  for (std::size_t part = 0;; ++part) {
    const std::uint32_t id = ids.u32();
    const ChunkWindow::Entry* const entry = reader.plans().find(id);
    if (entry == nullptr || entry->adds_to != before) return nullptr;
    before = std::uint64_t{id} + 1;
    if (part + 1 < its_mesh->coded.parts_wanted()) continue;
    const std::shared_ptr<const PlanPart> last = plan_in_force(id);
    return last == nullptr ? nullptr : last->plan;
  }
}

}  // namespace tvg
