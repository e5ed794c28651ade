#include <cstdint>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/encoder.hpp>
#include <tvg/simplify.hpp>

int main() {
  tvg::Sequence sequence;
  sequence.mesh = {4, {{0, 1, 2}, {0, 2, 3}}};
  sequence.frames.assign(2, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  tvg::SequenceSource source(sequence);
  tvg::EncodeOptions options;
  options.threads = 2;  // a static library must bring the threads it needs

  tvg::SimplifyOptions coarser;  // and the half-edges that simplification stands on
  coarser.vertex_counts = {4};
  if (!tvg::simplify(sequence.mesh, sequence.frames, {}, {}, coarser)) return 1;

  std::vector<std::uint8_t> bytes;
  const auto append = [&bytes](std::span<const std::uint8_t> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
    return tvg::Status();
  };
  if (!tvg::encode(source, options, append)) return 1;

  tvg::Decoder decoder;
  decoder.push(bytes);
  decoder.finish();
  int frames = 0;
  for (tvg::Decoder::Event event = decoder.poll(); event != tvg::Decoder::Event::kEnd;
       event = decoder.poll()) {
    if (event == tvg::Decoder::Event::kError || event == tvg::Decoder::Event::kDamage) return 1;
    if (event == tvg::Decoder::Event::kFrame) ++frames;
  }
  return frames == 2 ? 0 : 1;
}
