#include <array>
#include <cstdint>

#include <tvg/decoder.hpp>

int main() {
  const std::array<std::uint8_t, 16> foreign = {'n', 'o', 't', ' ', 'a', ' ', 's', 't'};
  tvg::Decoder decoder;
  decoder.push(foreign);
  decoder.finish();
  if (decoder.poll() != tvg::Decoder::Event::kError) return 1;
  return decoder.error().code == tvg::ErrorCode::kNotTvg ? 0 : 1;
}
