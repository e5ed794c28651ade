#pragma once
#include "modes/gop_input.hpp"
#include "modes/gop_mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// The flags of what is to be encoded, [traversal index]; empty where there is one lattice only.
std::vector<std::uint8_t> flags_in_traversal_order(const GopInput& input, const CodedMesh& mesh);

/// Such flags, coded (format-spec §7.4); no bytes where there are none.
std::vector<std::uint8_t> encode_flags(const CodedMesh& mesh, std::span<const std::uint8_t> flags);

}  // namespace tvg
