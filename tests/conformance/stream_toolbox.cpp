#include "stream_toolbox.hpp"

#include "corpus/corpus.hpp"

#include <cstdio>
#include <cstdlib>

namespace tvg::conformance {

[[noreturn]] void stop(const std::string& message) {
  std::fprintf(stderr, "conformance stream: %s\n", message.c_str());
  std::abort();
}

Stream encode_source(FrameSource& source, const EncodeOptions& options) {
  Stream stream;
  const auto report = encode(source, options, [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  if (!report) stop(report.error().describe());
  return stream;
}

Stream encode_sequence(const Sequence& sequence, const EncodeOptions& options) {
  SequenceSource source(sequence);
  return encode_source(source, options);
}

Sequence corpus_sequence(std::string_view name, std::uint32_t frames) {
  const corpus::CorpusEntry* entry = corpus::find_corpus_entry(name);
  if (entry == nullptr) stop("no sequence " + std::string(name));
  Sequence sequence = entry->make({100, frames}).sequence;
  sequence.metadata.clear();
  return sequence;
}

EncodeOptions options_of(int fine_bits, int coarse_bits, Predictor predictor, std::uint32_t gop_frames) {
  EncodeOptions options;
  options.fine_bits = fine_bits;
  options.coarse_bits = coarse_bits;
  options.predictor = predictor;
  options.gop_frames = gop_frames;
  return options;
}

Sequence triangle(std::uint32_t frames) {
  Sequence sequence;
  sequence.mesh = {4, {{0, 1, 2}}};
  for (std::uint32_t f = 0; f < frames; ++f) {
    const float t = static_cast<float>(f) / 8;
    sequence.frames.push_back({0, 0, t, 1, t, 0, t * t, 1 + t, 0.5F, -1, -t, 2});
  }
  return sequence;
}

}  // namespace tvg::conformance
