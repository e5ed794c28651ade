#include "modes/basis_encode.hpp"

#include "base/checksum.hpp"
#include "basis/row_coder.hpp"
#include "container/chunk.hpp"
#include "container/plan_payload.hpp"
#include "entropy/range_coder.hpp"
#include "modes/animated_encode.hpp"
#include "modes/gop_flags_encode.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace tvg {

namespace {

/// Errors of vertices on the coarse lattice count less by as much as its cells are larger.
std::vector<float> weights_of(std::span<const std::uint8_t> flags, const GopInput& input,
                              std::size_t vertices) {
  std::vector<float> weights(vertices, 1.0f);
  const float coarse = std::ldexp(1.0f, -input.lattice.shift());
  for (std::size_t v = 0; v < flags.size(); ++v) weights[v] = flags[v] != 0 ? 1.0f : coarse;
  return weights;
}

/// The digests of a basis, [part].
std::vector<Hasher> digests_of(const CodedMesh& mesh, const CodedCoefficients& coefficients) {
  std::vector<Hasher> digests(mesh.parts());
  for (const std::vector<Quad>& group : coefficients.values) {
    for (std::size_t v = 0; v < group.size(); ++v) {
      std::size_t part = 0;
      while (part + 1 < mesh.parts() && mesh.levels[v] >= mesh.level_behind(part)) ++part;
      digests[part].update(std::span<const std::int32_t>(group[v]));
    }
  }
  return digests;
}

void write_planes_header(ByteWriter& fields, const GopInput& input, Bytes coded_flags,
                         const FittedBasis& fitted) {
  BasisHeader header;
  header.components = static_cast<std::uint32_t>(fitted.coefficients.components);
  header.fine_bits = input.lattice.fine_bits;
  header.coarse_bits = input.lattice.coarse_bits;
  header.fraction_bits = fitted.fraction_bits;
  header.origin = input.lattice.origin;
  header.step = input.lattice.step * fitted.step;
  header.scales = fitted.scales;
  header.flags = coded_flags;
  write_basis_header(fields, header);
}

/// The chunks of the planes, which are named by `ids`. kLimitExceeded where one is too large.
Result<std::vector<std::vector<std::uint8_t>>> plan_chunks(const GopInput& input, const GopMesh& mesh,
                                                           std::span<const std::uint8_t> flags,
                                                           const FittedBasis& fitted,
                                                           const StreamLimits& limits, ByteWriter& ids) {
  std::vector<Hasher> digests = digests_of(mesh.coded, fitted.coefficients);
  std::vector<std::vector<std::uint8_t>> chunks;
  std::uint64_t adds_to = 0;
  for (std::size_t part = 0; part < mesh.coded.parts(); ++part) {
    ByteWriter fields;
    if (part == 0) write_planes_header(fields, input, encode_flags(mesh.coded, flags), fitted);
    for (const auto& group : fitted.coefficients.groups) {
      fields.varint(group[part].size());
      fields.bytes(group[part]);
    }
    fields.u64(digests[part].value());
    const std::vector<std::uint8_t> payload =
        write_plan({.mesh = mesh.coded.id, .adds_to = adds_to, .mode = kModeBasis, .fields = fields.data()});
    if (payload.size() > limits.plan_bytes)
      return Error{ErrorCode::kLimitExceeded,
                   "the planes of a basis are larger than the head declares",
                   {},
                   input.first_frame,
                   "§4.1"};
    ids.u32(checksum(payload));
    adds_to = std::uint64_t{checksum(payload)} + 1;
    chunks.push_back(write_chunk(kPlanChunk, false, payload));
  }
  return chunks;
}

/// A GOP of frames `first` to `first + count - 1` of the period.
Result<EncodedGop> encode_rows(const GopInput& input, const GopMesh& mesh, Bytes plan_ids,
                               const FittedBasis& fitted, std::size_t first, std::size_t count,
                               const StreamLimits& limits) {
  const std::size_t values = 3 * fitted.scales.size();
  RowCoder rows(fitted.scales);
  RangeEncoder coder;
  Hasher digest;
  std::vector<EncodedFrame> frames;
  for (std::size_t f = first; f < first + count; ++f) {
    std::vector<std::int32_t> frame(fitted.rows.begin() + static_cast<std::ptrdiff_t>(values * f),
                                    fitted.rows.begin() + static_cast<std::ptrdiff_t>(values * (f + 1)));
    rows.code_frame(coder, frame);
    digest.update(std::span<const std::int32_t>(frame));
    frames.push_back({Predictor::kRows, coder.finish()});
  }
  GopHeader header;
  header.mesh = mesh.coded.id;
  header.first_frame = input.first_frame + first;
  header.planes = plan_ids;
  header.mode = kModeBasis;
  return write_gop(header, std::move(frames), digest.value(), encode_channels(input, mesh, first, count),
                   limits);
}

}  // namespace

Result<EncodedRun> encode_basis(const GopInput& input, const GopMesh& mesh, const StreamLimits& limits) {
  if (input.lattice.fine_bits > kMostBasisBits) {
    const std::string asked = input.basis.largest_error ? "the largest error" : "the step";
    return Error{ErrorCode::kInvalidArgument,
                 asked + " is too small for mode basis: the box has " +
                     std::to_string(input.lattice.fine_bits) + " bits of such steps, and " +
                     std::to_string(kMostBasisBits) + " are possible; use mode elp",
                 {},
                 input.first_frame};
  }
  const std::vector<std::uint8_t> flags = flags_in_traversal_order(input, mesh.coded);
  const std::vector<float> weights = weights_of(flags, input, mesh.coded.order.size());
  const Trajectories trajectories =
      trajectories_of(input.frames, mesh.coded.order, weights, input.lattice.origin, input.lattice.step);
  // A coordinate that is rounded to the lattice has this mean squared error, in squared steps.
  FitTarget target;
  target.squared_error = static_cast<double>(trajectories.weighted.size()) / 12;
  target.largest_error = input.basis.largest_error;
  const auto part_ends = mesh.coded.part_ends();
  const FittedBasis fitted =
      fit_basis(trajectories, *mesh.pyramid, std::span(part_ends).first(mesh.coded.parts()), flags,
                input.lattice.shift(), target, input.basis.effort);
  if (target.largest_error && fitted.largest_error > *target.largest_error) {
    return Error{ErrorCode::kInvalidArgument,
                 "no basis has errors as small as that: use mode elp",
                 {},
                 input.first_frame};
  }
  EncodedRun run;
  run.largest_error = fitted.largest_error * input.lattice.step;
  ByteWriter ids;
  Result<std::vector<std::vector<std::uint8_t>>> plans = plan_chunks(input, mesh, flags, fitted, limits, ids);
  if (!plans) return plans.error();
  run.plans = std::move(*plans);
  const std::size_t gop_frames = input.basis.gop_frames;
  for (std::size_t first = 0; first < input.frames.size(); first += gop_frames) {
    Result<EncodedGop> gop = encode_rows(input, mesh, ids.data(), fitted, first,
                                         std::min(gop_frames, input.frames.size() - first), limits);
    if (!gop) return gop.error();
    run.gops.push_back(std::move(*gop));
  }
  return run;
}

}  // namespace tvg
