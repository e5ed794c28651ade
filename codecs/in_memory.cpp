#include "codecs/in_memory.hpp"

#include "tool/tool_error.hpp"

#include <tvg/decoder.hpp>

namespace tvg::bench {

namespace {

[[noreturn]] void fail_decoding(const std::string& what) {
  throw cli::ToolError(cli::ExitStatus::kOther, "decode: " + what);
}

}  // namespace

std::vector<std::uint8_t> encode_to_memory(FrameSource& source, const EncodeOptions& options,
                                           const std::string& name, const EncodeProgress& progress) {
  std::vector<std::uint8_t> bytes;
  const auto append = [&bytes](std::span<const std::uint8_t> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
    return Status();
  };
  const Result<EncodeReport> report = encode(source, options, append, progress);
  if (!report) throw cli::tool_error(name, report.error());
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
        throw cli::tool_error("decode", decoder.damage().error);
      case Decoder::Event::kError:
        throw cli::tool_error("decode", decoder.error());
      case Decoder::Event::kNeedBytes:
        fail_decoding("the stream ends too early");
      case Decoder::Event::kEnd:
        if (decoded != frames.size()) fail_decoding("frames are missing");
        return;
      default:
        break;
    }
  }
}

}  // namespace tvg::bench
