#include "decoder/decoder_state.hpp"

// In a file of its own: only programs that ask for bits are linked with the decoder that counts them.
namespace tvg {

void Decoder::measure_bits(bool on) {
  state_->measured_take = on ? &GopDecoder::take_measured : nullptr;
}

}  // namespace tvg
