#include "bench/rates.hpp"

#include "bench/sequences.hpp"
#include "codecs/in_memory.hpp"
#include "codecs/timing.hpp"

#include <cmath>
#include <span>
#include <stdexcept>

#include <tvg/decoder.hpp>

namespace tvg::bench {

namespace {

EncodeOptions uniform(int bits, std::uint32_t gop_frames) {
  EncodeOptions options;
  options.fine_bits = options.coarse_bits = bits;
  options.gop_frames = gop_frames;
  return options;
}

/// Decodes, and counts each step for the chunk that it works on.
DecodeTimes timed_decode(std::span<const std::uint8_t> bytes, std::vector<FramePositions>& frames) {
  DecodeTimes times;
  Decoder decoder;
  decoder.push(bytes);
  decoder.finish();
  std::size_t decoded = 0;
  double* spent = &times.frames;
  for (;;) {
    const double start = processor_seconds();
    const Decoder::Event event = decoder.poll();
    if (event == Decoder::Event::kFrame) decoder.copy_positions(frames.at(decoded++).data());
    *spent += processor_seconds() - start;
    if (event == Decoder::Event::kEnd) break;
    if (event == Decoder::Event::kDamage || event == Decoder::Event::kError ||
        event == Decoder::Event::kNeedBytes) {
      throw std::runtime_error("decode: what was encoded cannot be decoded");
    }
    if (event != Decoder::Event::kChunk) continue;
    const std::string& type = decoder.chunk().type;
    spent = type == "MESH" ? &times.mesh : type == "PLAN" ? &times.planes : &times.frames;
  }
  if (decoded != frames.size()) throw std::runtime_error("decode: frames are missing");
  return times;
}

}  // namespace

RateSetting elp_setting(Predictor predictor, std::uint32_t gop_frames, int bits) {
  RateSetting setting{predictor == Predictor::kElp ? "elp" : "elp + auto", uniform(bits, gop_frames)};
  setting.options.predictor = predictor;
  return setting;
}

RateSetting basis_setting(std::uint32_t period_frames, std::uint32_t gop_frames, int bits) {
  RateSetting setting{"basis, period " + std::to_string(period_frames), uniform(bits, gop_frames)};
  setting.options.mode = Mode::kBasis;
  setting.options.period_frames = period_frames;
  return setting;
}

RateSetting lossless_setting(std::uint32_t gop_frames) {
  RateSetting setting{"lossless", {}};
  setting.options.mode = Mode::kLossless;
  setting.options.gop_frames = gop_frames;
  return setting;
}

RateResult run_rate(const Sequence& sequence, const EncodeOptions& options) {
  RateResult result;
  SequenceSource source(sequence);
  const double start = processor_seconds();
  const std::vector<std::uint8_t> bytes = encode_to_memory(source, options);
  result.encode_seconds = processor_seconds() - start;
  result.bytes = bytes.size();
  std::vector<FramePositions> frames(sequence.frames.size(),
                                     FramePositions(3 * std::size_t{sequence.mesh.vertex_count}));
  for (int run = 0; run < 3; ++run) {
    const DecodeTimes times = timed_decode(bytes, frames);
    if (run == 0 || times.all() < result.decode.all()) result.decode = times;
  }
  result.errors = compare(sequence, frames);
  if (options.mode != Mode::kLossless) {
    result.lattice_rms = result.errors.extent / std::exp2(options.fine_bits) / std::sqrt(12.0);
  }
  return result;
}

}  // namespace tvg::bench
