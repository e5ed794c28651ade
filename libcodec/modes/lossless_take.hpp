#pragma once
#include "base/stream_error.hpp"
#include "modes/lossless.hpp"
#include "modes/lossless_decode.hpp"

// How a frame's packet is decoded, for the two files that do it: with an account of its bits and without.
namespace tvg {

// format-spec §7.9
template <class Coder>
Status LosslessDecoder::decode(Coder& coder) {
  const bool inside = along_pyramid_->code(coder, values_);
  if (!inside && !coder.overrun()) return malformed("§7.9.2", "a decoded number is none that the GOP has");
  if (!coder.finished()) return malformed("§6.1", "the frame's residuals do not fill its packet exactly");
  add_to_digest(digest_, values_);
  return {};
}

}  // namespace tvg
