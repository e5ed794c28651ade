#include "bench/in_memory.hpp"

#include <stdexcept>

#include <tvg/decoder.hpp>

namespace tvg::bench {

std::vector<std::uint8_t> encode_to_memory(FrameSource& source, const EncodeOptions& options) {
  std::vector<std::uint8_t> bytes;
  const auto append = [&bytes](std::span<const std::uint8_t> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
    return Status();
  };
  const Result<EncodeReport> report = encode(source, options, append);
  if (!report) throw std::runtime_error("encode: " + report.error().describe());
  return bytes;
}

void decode_from_memory(std::span<const std::uint8_t> bytes, std::vector<FramePositions>& frames) {
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

}  // namespace tvg::bench
