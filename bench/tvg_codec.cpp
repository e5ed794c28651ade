#include "bench/tvg_codec.hpp"

#include "bench/timing.hpp"

#include <stdexcept>

#include <tvg/decoder.hpp>
#include <tvg/encoder.hpp>

namespace tvg::bench {

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes encode_to_memory(const Sequence& sequence, const EncodeOptions& options) {
  Bytes bytes;
  SequenceSource source(sequence);
  const auto append = [&bytes](std::span<const std::uint8_t> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
    return Status();
  };
  const Result<EncodeReport> report = encode(source, options, append);
  if (!report) throw std::runtime_error("encode: " + report.error().describe());
  return bytes;
}

/// Decodes into frames of the right size; fails unless every frame comes and none is damaged.
void decode_from_memory(const Bytes& bytes, std::vector<FramePositions>& frames) {
  Decoder decoder;
  decoder.push(bytes);
  decoder.finish();
  std::size_t decoded = 0;
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kFrame:
        decoder.copy_positions(frames.at(decoded++).data());
        break;
      case Decoder::Event::kDamage:
        throw std::runtime_error("decode: " + decoder.damage().error.describe());
      case Decoder::Event::kError:
        throw std::runtime_error("decode: " + decoder.error().describe());
      case Decoder::Event::kNeedBytes:
        throw std::runtime_error("decode: the stream ends too early");
      case Decoder::Event::kEnd:
        if (decoded != frames.size()) throw std::runtime_error("decode: frames are missing");
        return;
      default:
        break;
    }
  }
}

}  // namespace

TvgResult run_tvg(const Sequence& sequence, const TvgSettings& settings) {
  EncodeOptions options;
  options.fine_bits = settings.fine_bits;
  options.coarse_bits = settings.coarse_bits;
  options.importance.share = settings.important_share;
  options.gop_frames = settings.gop_frames;
  TvgResult result;
  result.codec.name = "TVG";
  Bytes bytes;
  result.codec.encode_seconds = best_time([&] { bytes = encode_to_memory(sequence, options); });
  result.codec.bytes = bytes.size();
  result.frames.assign(sequence.frames.size(), FramePositions(3 * std::size_t{sequence.mesh.vertex_count}));
  result.codec.decode_seconds = best_time([&] { decode_from_memory(bytes, result.frames); });
  result.codec.exact = true;
  return result;
}

}  // namespace tvg::bench
