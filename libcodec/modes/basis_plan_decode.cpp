#include "base/allocation.hpp"
#include "base/checksum.hpp"
#include "base/stream_error.hpp"
#include "entropy/range_coder.hpp"
#include "modes/basis_plan.hpp"
#include "planes/coefficient_coder.hpp"
#include "quantization/flag_coder.hpp"

#include <algorithm>
#include <utility>

namespace tvg {

namespace {

constexpr const char* kSection = "§7.8.1";
constexpr Fault kNoMemory{"", "out of memory", ErrorCode::kOutOfMemory};

std::size_t groups_of(std::uint32_t components) {
  return (std::size_t{components} + CoefficientCoder::kPlanes - 1) / CoefficientCoder::kPlanes;
}

/// The group's planes, which are to be had from all of its bytes.
Fault decode_group(Bytes bytes, CoefficientCoder& coefficients, std::span<Quad> planes, std::size_t count) {
  RangeDecoder coder(bytes);
  const auto nothing = [](const auto&...) { return Quad{}; };
  const bool inside = coefficients.code(coder, planes, count, nothing);
  if (!inside && !coder.overrun()) return {"§7.8.2", "a coefficient is out of range"};
  if (!coder.finished()) return {"§6.1", "planes of a basis do not fill their bytes exactly"};
  return {};
}

Fault decode_planes(ByteReader& reader, BasisPlan& plan, std::uint32_t most_components) {
  const std::size_t vertices = plan.mesh->coded.gates.size();
  const std::uint32_t components = plan.header.components;
  const std::size_t groups = groups_of(components), wanted = groups_of(std::min(components, most_components));
  // Of planes that are left out there is nothing to add up.
  const std::size_t kept = std::min<std::size_t>(components, wanted * CoefficientCoder::kPlanes);
  if (!plan.planes.reserve(vertices, kept)) return kNoMemory;
  if (!can_allocate(vertices * (CoefficientCoder::kBytesPerVertex + sizeof(Quad)) +
                    CoefficientCoder::kMostOtherBytes))
    return kNoMemory;
  CoefficientCoder coefficients(*plan.mesh->pyramid, plan.flags, plan.header.nested_bits());
  std::vector<Quad> planes(vertices);
  Hasher digest;
  for (std::size_t group = 0; group < groups; ++group) {
    const Bytes bytes = reader.bytes(reader.varint());
    if (!reader.ok()) return {kSection, "the planes of a basis are longer than its chunk"};
    if (group >= wanted) continue;
    const std::size_t count =
        std::min(CoefficientCoder::kPlanes, components - CoefficientCoder::kPlanes * group);
    if (const Fault fault = decode_group(bytes, coefficients, planes, count)) return fault;
    if (!plan.planes.put(group, planes)) return kNoMemory;
    for (const Quad& quad : planes) digest.update(std::span<const std::int32_t>(quad));
  }
  const std::uint64_t expected = reader.u64();
  if (!reader.finished()) return {kSection, "the planes of a basis do not fill its chunk exactly"};
  if (wanted == groups && digest.value() != expected)
    return {kSection, "a basis decoded to other values than were encoded", ErrorCode::kDigestMismatch};
  return {};
}

// format-spec §7.8.1
Fault decode(ByteReader& reader, const StreamLimits& limits, BasisPlan& plan, std::uint32_t most_components) {
  if (const Fault fault = read_basis_header(reader, limits, plan.header)) return fault;
  if (!plan.mesh->pyramid) return {kSection, "a basis is for a mesh that has no reference shape"};
  if (!try_reserve(plan.scales, plan.header.scales.size())) return kNoMemory;
  plan.scales.assign(plan.header.scales.begin(), plan.header.scales.end());
  if (plan.header.nested_bits() > 0) {
    if (!try_resize(plan.flags, plan.mesh->coded.gates.size())) return kNoMemory;
    if (const Fault fault = decode_flags(plan.header.flags, plan.mesh->coded.gates, plan.flags)) return fault;
  }
  plan.header.scales = plan.scales;
  plan.header.flags = {};
  return decode_planes(reader, plan, most_components);
}

}  // namespace

Result<BasisPlan> decode_basis_plan(Bytes fields, std::shared_ptr<const GopMesh> mesh,
                                    const StreamLimits& limits, std::uint32_t most_components) {
  BasisPlan plan;
  plan.mesh = std::move(mesh);
  ByteReader reader(fields);
  if (const Fault fault = decode(reader, limits, plan, most_components)) return error_of(fault);
  return plan;
}

}  // namespace tvg
