#include "modes/basis_encode.hpp"

#include "base/checksum.hpp"
#include "basis/row_coder.hpp"
#include "container/chunk.hpp"
#include "container/plan_payload.hpp"
#include "entropy/range_coder.hpp"
#include "modes/channels.hpp"
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

std::vector<std::uint8_t> plan_payload(const GopInput& input, const GopMesh& mesh,
                                       std::span<const std::uint8_t> flags, const FittedBasis& fitted) {
  const std::vector<std::uint8_t> coded_flags = encode_flags(mesh.coded, flags);
  ByteWriter fields;
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
  Hasher digest;
  for (std::size_t group = 0; group < fitted.coefficients.groups.size(); ++group) {
    fields.varint(fitted.coefficients.groups[group].size());
    fields.bytes(fitted.coefficients.groups[group]);
    for (const Quad& quad : fitted.coefficients.values[group])
      digest.update(std::span<const std::int32_t>(quad));
  }
  fields.u64(digest.value());
  return write_plan({.mesh = mesh.coded.id, .adds_to = 0, .mode = kModeBasis, .fields = fields.data()});
}

/// A GOP of frames `first` to `first + count - 1` of the period.
Result<EncodedGop> encode_rows(const GopInput& input, const GopMesh& mesh, std::uint32_t plan_id,
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
  ByteWriter ids, fields;
  ids.u32(plan_id);
  write_channels(fields);
  GopHeader header;
  header.mesh = mesh.coded.id;
  header.first_frame = input.first_frame + first;
  header.planes = ids.data();
  header.mode = kModeBasis;
  header.fields = fields.data();
  return write_gop(header, frames, digest.value(), limits);
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
  const FittedBasis fitted =
      fit_basis(trajectories, *mesh.pyramid, flags, input.lattice.shift(), target, input.basis.effort);
  if (target.largest_error && fitted.largest_error > *target.largest_error) {
    return Error{ErrorCode::kInvalidArgument,
                 "no basis has errors as small as that: use mode elp",
                 {},
                 input.first_frame};
  }
  EncodedRun run;
  run.largest_error = fitted.largest_error * input.lattice.step;
  const std::vector<std::uint8_t> payload = plan_payload(input, mesh, flags, fitted);
  if (payload.size() > limits.plan_bytes)
    return Error{ErrorCode::kLimitExceeded,
                 "the planes of a basis are larger than the head declares",
                 {},
                 input.first_frame,
                 "§4.1"};
  run.plan = write_chunk(kPlanChunk, false, payload);
  const std::uint32_t plan_id = checksum(payload);
  const std::size_t gop_frames = input.basis.gop_frames;
  for (std::size_t first = 0; first < input.frames.size(); first += gop_frames) {
    Result<EncodedGop> gop = encode_rows(input, mesh, plan_id, fitted, first,
                                         std::min(gop_frames, input.frames.size() - first), limits);
    if (!gop) return gop.error();
    run.gops.push_back(std::move(*gop));
  }
  return run;
}

}  // namespace tvg
