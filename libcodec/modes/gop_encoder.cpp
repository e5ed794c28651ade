#include "modes/gop_encoder.hpp"

#include "modes/animated_encode.hpp"
#include "modes/basis_encode.hpp"
#include "modes/elp_encode.hpp"
#include "modes/lossless_encode.hpp"

#include <utility>

namespace tvg {

namespace {

/// A GOP in a mode that codes frame by frame.
template <class ModeEncoder>
Result<EncodedRun> encode_gop_in(const GopInput& input, const GopMesh& mesh, const StreamLimits& limits) {
  ModeEncoder mode(input, mesh);
  std::vector<EncodedFrame> frames;
  for (const FramePositions& frame : input.frames) frames.push_back(mode.take(frame));
  const std::vector<std::uint8_t> fields = mode.finish();
  GopHeader header;
  header.mesh = mesh.coded.id;
  header.first_frame = input.first_frame;
  header.mode = static_cast<std::uint64_t>(input.mode);
  header.fields = fields;
  Result<EncodedGop> gop = write_gop(header, std::move(frames), mode.digest(),
                                     encode_channels(input, mesh, 0, input.frames.size()), limits);
  if (!gop) return gop.error();
  EncodedRun run;
  run.gops.push_back(std::move(*gop));
  return run;
}

}  // namespace

Result<EncodedRun> encode_run(const GopInput& input, const GopMesh& mesh, const StreamLimits& limits) {
  switch (input.mode) {
    case Mode::kBasis:
      return encode_basis(input, mesh, limits);
    case Mode::kLossless:
      return encode_gop_in<LosslessEncoder>(input, mesh, limits);
    case Mode::kElp:
      break;
  }
  return encode_gop_in<ElpEncoder>(input, mesh, limits);
}

}  // namespace tvg
