#include "bench/tvg_codec.hpp"

#include "codecs/in_memory.hpp"
#include "codecs/timing.hpp"

#include <tvg/encoder.hpp>

namespace tvg::bench {

TvgResult run_tvg(const Sequence& sequence, const TvgSettings& settings) {
  EncodeOptions options;
  options.fine_bits = settings.fine_bits;
  options.coarse_bits = settings.coarse_bits;
  options.importance.share = settings.important_share;
  options.gop_frames = settings.gop_frames;
  TvgResult result;
  result.codec.name = "TVG";
  std::vector<std::uint8_t> bytes;
  SequenceSource source(sequence);
  result.codec.encode_seconds = best_time([&] { bytes = encode_to_memory(source, options); });
  result.codec.bytes = bytes.size();
  result.frames.assign(sequence.frames.size(), FramePositions(3 * std::size_t{sequence.mesh.vertex_count}));
  result.codec.decode_seconds = best_time([&] { decode_from_memory(bytes, result.frames); });
  result.codec.exact = true;
  return result;
}

}  // namespace tvg::bench
