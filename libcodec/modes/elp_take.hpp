#pragma once
#include "base/stream_error.hpp"
#include "modes/elp_decode.hpp"

#include <utility>

// How a frame's packet is decoded, for the two files that do it: with an account of its bits and without.
namespace tvg {

// format-spec §7.5
template <class Coder>
Status ElpDecoder::decode(Coder& coder, Predictor predictor) {
  positions_->next();
  ++frames_taken_;
  const bool inside = code_frame(coder, predictor, *positions_, along_pyramid_, mesh_->shape);
  if (!inside && !coder.overrun()) return malformed("§7.5", "a decoded index lies outside its lattice");
  if (!coder.finished()) return malformed("§6.1", "the frame's residuals do not fill its packet exactly");
  add_to_digest(digest_, std::as_const(*positions_).indices());
  return {};
}

}  // namespace tvg
