#pragma once
#include "modes/channels.hpp"
#include "modes/gop_input.hpp"
#include "modes/gop_mesh.hpp"

#include <cstddef>
#include <vector>

namespace tvg {

/// Encodes the animated attributes of a GOP, which has `count` of the frames given, `first` the first: the
/// mirror of AnimatedDecoder (format-spec §5.7.7).
std::vector<EncodedChannel> encode_channels(const GopInput& input, const GopMesh& mesh, std::size_t first,
                                            std::size_t count);

}  // namespace tvg
