#include <cstdint>
#include <vector>

#include <tvg/stream_decoder.hpp>
#include <tvg/stream_encoder.hpp>

// The C interface by its owners, in C++17.
int main() {
  std::vector<std::uint8_t> stream;
  tvg::StreamEncoder encoder([&stream](const void* bytes, std::size_t size) {
    const auto* const first = static_cast<const std::uint8_t*>(bytes);
    stream.insert(stream.end(), first, first + size);
    return true;
  });
  const std::uint32_t face[] = {0, 1, 2};
  const float frame[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  if (encoder.set_mesh(3, face, 1) != TVG_OK || encoder.add_frame(frame, 9) != TVG_OK || !encoder.finish())
    return 1;

  tvg::StreamDecoder decoder;
  decoder.push(stream.data(), stream.size());
  decoder.finish();
  int frames = 0;
  for (tvg_event event = decoder.poll(); event != TVG_EVENT_END; event = decoder.poll()) {
    if (event == TVG_EVENT_ERROR || event == TVG_EVENT_DAMAGE) return 1;
    if (event == TVG_EVENT_FRAME) ++frames;
  }
  return frames == 1 ? 0 : 1;
}
