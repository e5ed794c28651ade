#include "modes/elp_take.hpp"
#include "planes/metered_decoder.hpp"

// Apart from the rest of the mode: only programs that ask for bits are linked with the coder once more.
namespace tvg {

Status ElpDecoder::take_measured(Bytes packet, std::array<double, 3>& bits) {
  MeteredDecoder<3> coder(packet);
  Status status = decode(coder);
  bits = coder.bits();
  return status;
}

}  // namespace tvg
