#pragma once
#include "container/layout.hpp"

#include <cstdint>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

// What can be checked of a stream's chunks without decoding them: for programs that pass chunks on. Errors
// carry the section and no place; the caller knows that.
namespace tvg {

/// Whether a head's limits lie within what the caller allows (format-spec §8.1).
Status check_declared(const StreamLimits& declared, const DecoderLimits& allowed);

/// The longest payload a mesh chunk of such a stream may have (§4.3).
constexpr std::uint64_t most_mesh_bytes(const StreamLimits& limits) {
  return 64 + 16 * (std::uint64_t{limits.vertices} + limits.faces);
}

/// Whether a mesh chunk's payload has the layout of one, with counts the head allows.
Status check_mesh_payload(Bytes payload, const StreamLimits& limits);

/// A GOP's header packet whose checksum fits, with counts the head allows.
Result<GopHeader> check_gop_header(Bytes packet, const StreamLimits& limits);

/// The header of a GOP all of whose packets are there, fit their checksums and belong to the mesh with this
/// payload checksum. What the packets decode to is not looked at.
Result<GopHeader> check_gop_payload(Bytes payload, std::uint32_t mesh_checksum, const StreamLimits& limits);

}  // namespace tvg
