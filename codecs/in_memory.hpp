#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/source.hpp>

namespace tvg::bench {

/// The stream of a source that can be rewound. Throws ToolError, with `name` for the source, where encoding
/// fails.
std::vector<std::uint8_t> encode_to_memory(FrameSource& source, const EncodeOptions& options,
                                           const std::string& name = "encode",
                                           const EncodeProgress& progress = {});

/// Decodes into frames of the right size. Throws ToolError unless every frame comes and none is
/// damaged.
void decode_from_memory(std::span<const std::uint8_t> bytes, std::vector<FramePositions>& frames);

}  // namespace tvg::bench
