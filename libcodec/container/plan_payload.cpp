#include "container/plan_payload.hpp"

#include "base/stream_error.hpp"
#include "container/gop_header.hpp"

namespace tvg {

namespace {

constexpr std::uint64_t kMostAddsTo = std::uint64_t{1} << 32;

}  // namespace

std::vector<std::uint8_t> write_plan(const PlanHeader& plan) {
  ByteWriter writer;
  writer.u32(plan.mesh);
  writer.varint(plan.adds_to);
  writer.varint(plan.mode);
  writer.bytes(plan.fields);
  return writer.take();
}

// format-spec §4.9
Fault read_plan(Bytes payload, PlanHeader& plan) {
  ByteReader reader(payload);
  plan.mesh = reader.u32();
  plan.adds_to = reader.varint();
  plan.mode = reader.varint();
  if (!reader.ok()) return {"§4.9", "the chunk of planes is too short"};
  if (plan.adds_to > kMostAddsTo) return {"§4.9", "planes add to others that have no name"};
  if (plan.mode == kModeElp) return {"§4.9", "GOPs in mode elp share no planes"};
  plan.fields = reader.bytes(reader.left());
  return {};
}

}  // namespace tvg
