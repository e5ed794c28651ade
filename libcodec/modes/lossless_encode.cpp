#include "modes/lossless_encode.hpp"

#include "base/bits.hpp"
#include "modes/lossless.hpp"
#include "modes/lossless_line_encode.hpp"

namespace tvg {

LosslessEncoder::LosslessEncoder(const GopInput& input, const GopMesh& mesh)
    : mesh_(mesh),
      line_(line_of(input.frames)),
      values_(mesh.coded.order.size()),
      along_pyramid_(*mesh.pyramid, mesh.shape, line_.line()) {}

// format-spec §7.9
EncodedFrame LosslessEncoder::take(const FramePositions& frame) {
  for (std::size_t v = 0; v < values_.size(); ++v) {
    const std::size_t at = 3 * std::size_t{mesh_.coded.order[v]};
    const auto value = [&](std::size_t axis) {
      return value_of_float(bits_as<std::uint32_t>(frame[at + axis]));
    };
    values_[v] = Reals(value(0), value(1), value(2), 0);
  }
  along_pyramid_.code(coder_, values_);
  add_to_digest(digest_, values_);
  return {Predictor::kPyramid, coder_.finish()};
}

}  // namespace tvg
