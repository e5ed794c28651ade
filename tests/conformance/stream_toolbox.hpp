#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/encoder.hpp>

// What makers of conformance streams have in common.
namespace tvg::conformance {

using Stream = std::vector<std::uint8_t>;

/// Ends the program: a stream cannot be made.
[[noreturn]] void stop(const std::string& message);

Stream encode_source(FrameSource& source, const EncodeOptions& options);
Stream encode_sequence(const Sequence& sequence, const EncodeOptions& options);
/// About 100 vertices, without metadata, which every stream would repeat.
Sequence corpus_sequence(std::string_view name, std::uint32_t frames);
EncodeOptions options_of(int fine_bits, int coarse_bits, Predictor predictor, std::uint32_t gop_frames);
/// One triangle that turns and grows a little in each frame, beside a vertex of no face.
Sequence triangle(std::uint32_t frames);

}  // namespace tvg::conformance
