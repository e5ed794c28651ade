#include "container/stream_checks.hpp"

#include "base/checksum.hpp"

#include <optional>
#include <utility>

namespace tvg {

namespace {

Error problem(ErrorCode code, const char* message, const char* section) {
  return {code, message, {}, {}, section};
}

struct Packet {
  Bytes bytes;
  std::uint32_t checksum;
};

/// The next packet of a GOP. Empty where what follows is none.
std::optional<Packet> read_packet(ByteReader& gop, std::uint64_t seed, const StreamLimits& limits) {
  const std::uint64_t size = gop.varint();
  if (!gop.ok() || size > limits.packet_bytes) return std::nullopt;
  const Bytes bytes = gop.bytes(size);
  const std::uint32_t expected = gop.u32();
  if (!gop.ok() || expected != checksum(bytes, seed)) return std::nullopt;
  return Packet{bytes, expected};
}

}  // namespace

Status check_declared(const StreamLimits& declared, const DecoderLimits& allowed) {
  if (declared.vertices <= allowed.vertices && declared.faces <= allowed.faces &&
      declared.frames_per_gop <= allowed.frames_per_gop && declared.packet_bytes <= allowed.packet_bytes &&
      declared.decoder_memory <= allowed.memory) {
    return {};
  }
  return problem(ErrorCode::kLimitExceeded, "the stream declares more than the limits set here allow",
                 "§8.1");
}

// format-spec §4.3
Status check_mesh_payload(Bytes payload, const StreamLimits& limits) {
  const Result<MeshLayout> mesh = read_mesh(payload);
  if (!mesh) return mesh.error();
  if (mesh->vertex_count <= limits.vertices && mesh->face_count <= limits.faces) return {};
  return problem(ErrorCode::kLimitExceeded, "a mesh is larger than the stream's head declares", "§4.3");
}

// format-spec §4.5.1
Result<GopHeader> check_gop_header(Bytes packet, const StreamLimits& limits) {
  Result<GopHeader> header = read_gop_header(packet);
  if (!header || header->frame_count <= limits.frames_per_gop) return header;
  return problem(ErrorCode::kLimitExceeded, "a GOP has more frames than the stream's head declares",
                 "§4.5.1");
}

// format-spec §4.5
Result<GopHeader> check_gop_payload(Bytes payload, std::uint32_t mesh_checksum, const StreamLimits& limits) {
  const Error damaged = problem(ErrorCode::kChecksumMismatch, "a packet is damaged", "§4.5");
  ByteReader gop(payload);
  const std::optional<Packet> first = read_packet(gop, 0, limits);
  if (!first) return damaged;
  Result<GopHeader> header = check_gop_header(first->bytes, limits);
  if (!header) return header;
  // After the frames comes the digest, a packet like them.
  for (std::uint32_t index = 1; index <= std::uint64_t{header->frame_count} + 1; ++index) {
    if (!read_packet(gop, packet_seed(first->checksum, mesh_checksum, index), limits)) return damaged;
  }
  if (gop.finished()) return header;
  return problem(ErrorCode::kMalformed, "bytes follow a GOP's digest", "§4.5");
}

}  // namespace tvg
