#include "container/head.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace tvg {

std::vector<std::uint8_t> write_head(const StreamLimits& limits) {
  ByteWriter head;
  head.u16(kFormatMajor);
  head.u16(kFormatMinor);
  head.u32(0);
  head.u32(limits.vertices);
  head.u32(limits.faces);
  head.u32(limits.frames_per_gop);
  head.u32(limits.packet_bytes);
  head.u64(limits.decoder_memory);
  return head.take();
}

// format-spec §4.1
Result<StreamHead> read_head(Bytes payload) {
  if (!can_allocate(kSmallThings)) return out_of_memory();
  ByteReader reader(payload);
  StreamHead head;
  head.major = reader.u16();
  head.minor = reader.u16();
  if (!reader.ok()) return malformed("§4.1", "the head is too short");
  if (head.major != kFormatMajor || head.minor > kFormatMinor) {
    const auto name = [](int major, int minor) {
      return std::to_string(major) + "." + std::to_string(minor);
    };
    return stream_error(ErrorCode::kUnsupportedVersion, "§4.1",
                        {"the stream has format version ", name(head.major, head.minor),
                         ", this decoder reads up to ", name(kFormatMajor, kFormatMinor)});
  }
  const std::uint32_t reserved = reader.u32();
  head.limits.vertices = reader.u32();
  head.limits.faces = reader.u32();
  head.limits.frames_per_gop = reader.u32();
  head.limits.packet_bytes = reader.u32();
  head.limits.decoder_memory = reader.u64();
  if (!reader.finished() || reserved != 0)
    return malformed("§4.1", "the head has a wrong size or reserved bits set");
  if (head.limits.decoder_memory != decoder_memory_needed(head.limits)) {
    return malformed("§4.1", "the declared decoder memory does not follow from the declared limits");
  }
  return head;
}

// format-spec §8.1
Status check_declared(const StreamLimits& declared, const DecoderLimits& allowed) {
  struct Bound {
    const char* what;
    std::uint64_t asked, allowed;
  };
  const std::array bounds = {
      Bound{"vertices", declared.vertices, allowed.vertices},
      Bound{"faces", declared.faces, allowed.faces},
      Bound{"frames per GOP", declared.frames_per_gop, allowed.frames_per_gop},
      Bound{"bytes per packet", declared.packet_bytes, allowed.packet_bytes},
      Bound{"bytes of decoder memory", declared.decoder_memory, allowed.memory},
  };
  for (const Bound& bound : bounds) {
    if (bound.asked <= bound.allowed) continue;
    if (!can_allocate(kSmallThings)) return out_of_memory();
    return stream_error(ErrorCode::kLimitExceeded, "§8.1",
                        {"the stream declares ", std::to_string(bound.asked), " ", bound.what,
                         ", the limit set here is ", std::to_string(bound.allowed)});
  }
  return {};
}

StreamLimits larger_limits(const StreamLimits& a, const StreamLimits& b) {
  StreamLimits limits;
  limits.vertices = std::max(a.vertices, b.vertices);
  limits.faces = std::max(a.faces, b.faces);
  limits.frames_per_gop = std::max(a.frames_per_gop, b.frames_per_gop);
  limits.packet_bytes = std::max(a.packet_bytes, b.packet_bytes);
  limits.decoder_memory = decoder_memory_needed(limits);
  return limits;
}

}  // namespace tvg
