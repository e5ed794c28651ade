#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/source.hpp>

namespace tvg::bench {

/// The stream of a source that can be rewound. Throws std::runtime_error where encoding fails.
std::vector<std::uint8_t> encode_to_memory(FrameSource& source, const EncodeOptions& options);

/// Decodes into frames of the right size. Throws std::runtime_error unless every frame comes and none is
/// damaged.
void decode_from_memory(std::span<const std::uint8_t> bytes, std::vector<FramePositions>& frames);

}  // namespace tvg::bench
