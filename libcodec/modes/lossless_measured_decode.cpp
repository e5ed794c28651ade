#include "modes/lossless_take.hpp"
#include "planes/metered_decoder.hpp"

// Apart from the rest of the mode: only programs that ask for bits are linked with the coder once more.
namespace tvg {

Status LosslessDecoder::take_measured(Bytes packet, Predictor predictor, std::array<double, 3>& bits) {
  const Result<Bytes> positions = open(packet, predictor);
  if (!positions) return positions.error();
  MeteredDecoder<3> coder(*positions);
  Status status = decode(coder);
  bits = coder.bits();
  return status;
}

}  // namespace tvg
