#include "base/allocation.hpp"
#include "base/checksum.hpp"
#include "base/stream_error.hpp"
#include "entropy/range_coder.hpp"
#include "modes/basis_plan.hpp"
#include "planes/coefficient_coder.hpp"
#include "quantization/flag_coder.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tvg {

namespace {

constexpr const char* kSection = "§7.8.1";
constexpr Fault kNoMemory{"", "out of memory", ErrorCode::kOutOfMemory};

std::size_t groups_of(std::uint32_t components) {
  return (std::size_t{components} + CoefficientCoder::kPlanes - 1) / CoefficientCoder::kPlanes;
}

/// A part of a group's planes, which is to be had from all of its bytes.
Fault decode_part(Bytes bytes, CoefficientCoder& coefficients, std::size_t part, std::span<Quad> planes) {
  RangeDecoder coder(bytes);
  const auto nothing = [](const auto&...) { return Quad{}; };
  const bool inside = coefficients.code_part(part, coder, planes, nothing);
  if (!inside && !coder.overrun()) return {"§7.8.2", "a coefficient is out of range"};
  if (!coder.finished()) return {"§6.1", "planes of a basis do not fill their bytes exactly"};
  return {};
}

/// The parts of a plan on the way through their groups.
class PlanReader {
 public:
  PlanReader(std::span<const Bytes> parts, const StreamLimits& limits, BasisPlan& plan)
      : limits_(limits), plan_(plan), mesh_(plan.mesh->coded), count_(parts.size()) {
    for (std::size_t part = 0; part < count_; ++part) readers_[part] = ByteReader(parts[part]);
  }

  // format-spec §7.8.1
  Fault run(std::uint32_t most_components) {
    if (const Fault fault = read_header()) return fault;
    const std::uint32_t components = plan_.header.components;
    const std::size_t groups = groups_of(components),
                      wanted = groups_of(std::min(components, most_components));
    if (const Fault fault = decode_groups(groups, wanted)) return fault;
    for (std::size_t part = 0; part < count_; ++part) {
      const std::uint64_t expected = readers_[part].u64();
      if (!readers_[part].finished())
        return {kSection, "the planes of a basis do not fill their chunk exactly"};
      if (wanted == groups && digests_[part].value() != expected)
        return {kSection, "a basis decoded to other values than were encoded", ErrorCode::kDigestMismatch};
    }
    return {};
  }

 private:
  Fault read_header() {
    BasisHeader& header = plan_.header;
    if (const Fault fault = read_basis_header(readers_.front(), limits_, header)) return fault;
    if (!plan_.mesh->pyramid) return {kSection, "a basis is for a mesh that has no reference shape"};
    if (!try_reserve(plan_.scales, header.scales.size())) return kNoMemory;
    plan_.scales.assign(header.scales.begin(), header.scales.end());
    if (header.nested_bits() > 0) {
      if (!try_resize(plan_.flags, mesh_.gates.size())) return kNoMemory;
      if (const Fault fault = decode_flags(header.flags, mesh_.gates, plan_.flags)) return fault;
    }
    header.scales = plan_.scales;
    header.flags = {};
    return {};
  }

  Fault decode_groups(std::size_t groups, std::size_t wanted) {
    const std::size_t vertices = mesh_.gates.size(), drawn = mesh_.drawn().vertex_count;
    const std::uint32_t components = plan_.header.components;
    // Of planes that are left out there is nothing to add up.
    const std::size_t kept = std::min<std::size_t>(components, wanted * CoefficientCoder::kPlanes);
    if (!plan_.planes.reserve(drawn, kept)) return kNoMemory;
    if (!can_allocate(vertices * (CoefficientCoder::kBytesPerVertex + sizeof(Quad)) +
                      (mesh_.cut.whole() ? 0 : drawn * sizeof(Quad)) + CoefficientCoder::most_bytes(count_)))
      return kNoMemory;
    const auto ends = mesh_.part_ends();
    CoefficientCoder coefficients(*plan_.mesh->pyramid, plan_.flags, plan_.header.nested_bits(),
                                  std::span(ends).first(count_));
    std::vector<Quad> planes(vertices), drawn_planes(mesh_.cut.whole() ? 0 : drawn);
    for (std::size_t group = 0; group < groups; ++group) {
      if (group < wanted)
        coefficients.begin_group(
            std::min(CoefficientCoder::kPlanes, components - CoefficientCoder::kPlanes * group));
      for (std::size_t part = 0; part < count_; ++part) {
        const Bytes bytes = readers_[part].bytes(readers_[part].varint());
        if (!readers_[part].ok()) return {kSection, "the planes of a basis are longer than its chunk"};
        if (group >= wanted) continue;
        if (const Fault fault = decode_part(bytes, coefficients, part, planes)) return fault;
      }
      if (group >= wanted) continue;
      coefficients.end_group();
      digest(planes);
      for (std::size_t v = 0; v < drawn_planes.size(); ++v) drawn_planes[v] = planes[mesh_.cut.vertices[v]];
      if (!plan_.planes.put(group, mesh_.cut.whole() ? planes : drawn_planes)) return kNoMemory;
    }
    return {};
  }

  void digest(std::span<const Quad> planes) {
    if (mesh_.parts() == 1) {
      for (const Quad& quad : planes) digests_.front().update(std::span<const std::int32_t>(quad));
      return;
    }
    for (std::size_t part = 0; part < count_; ++part) {
      const std::uint32_t first = part == 0 ? 0 : mesh_.level_behind(part - 1),
                          end = mesh_.level_behind(part);
      for (std::size_t v = 0; v < planes.size(); ++v) {
        if (mesh_.levels[v] >= first && mesh_.levels[v] < end)
          digests_[part].update(std::span<const std::int32_t>(planes[v]));
      }
    }
  }

  const StreamLimits& limits_;
  BasisPlan& plan_;
  const CodedMesh& mesh_;
  std::size_t count_;
  std::array<ByteReader, kMaxCoarseMeshes + 1> readers_;
  std::array<Hasher, kMaxCoarseMeshes + 1> digests_;
};

}  // namespace

Result<BasisPlan> decode_basis_plan(std::span<const Bytes> parts, std::shared_ptr<const GopMesh> mesh,
                                    const StreamLimits& limits, std::uint32_t most_components) {
  BasisPlan plan;
  plan.mesh = std::move(mesh);
  if (const Fault fault = PlanReader(parts, limits, plan).run(most_components)) return error_of(fault);
  return plan;
}

}  // namespace tvg
