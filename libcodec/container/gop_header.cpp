#include "container/gop_header.hpp"

#include "base/stream_error.hpp"

namespace tvg {

namespace {

constexpr std::uint64_t kMostFirstFrame = std::uint64_t{1} << 62;
constexpr std::uint64_t kMostPackets = 0x7FFFFFFF;

}  // namespace

std::vector<std::uint8_t> write_gop_header(const GopHeader& header) {
  ByteWriter writer;
  writer.u32(header.mesh);
  writer.varint(header.first_frame);
  writer.varint(header.frame_count);
  writer.varint(header.packet_count);
  writer.varint(header.plane_count());
  writer.bytes(header.planes);
  writer.varint(header.mode);
  writer.bytes(header.fields);
  return writer.take();
}

namespace {

// format-spec §4.5.1
Fault parse(ByteReader reader, GopHeader& header) {
  constexpr const char* kSection = "§4.5.1";
  constexpr Fault kShort{kSection, "the GOP's header is too short"};
  header.mesh = reader.u32();
  header.first_frame = reader.varint();
  const std::uint64_t frame_count = reader.varint();
  const std::uint64_t packet_count = reader.varint();
  const std::uint64_t planes = reader.varint();
  if (!reader.ok()) return kShort;
  if (frame_count == 0 || frame_count > 0xFFFFFFFF || header.first_frame > kMostFirstFrame)
    return {kSection, "the GOP's frame numbers are out of range"};
  if (packet_count <= frame_count || packet_count > kMostPackets)
    return {kSection, "the number of the GOP's packets is out of range"};
  if (planes > GopHeader::kMostPlanes) return {kSection, "the GOP names too many planes"};
  header.frame_count = static_cast<std::uint32_t>(frame_count);
  header.packet_count = static_cast<std::uint32_t>(packet_count);
  header.planes = reader.bytes(4 * planes);
  header.mode = reader.varint();
  if (!reader.ok()) return kShort;
  header.fields = reader.bytes(reader.left());
  return {};
}

}  // namespace

Result<GopHeader> read_gop_header(Bytes packet) {
  GopHeader header;
  if (const Fault fault = parse(ByteReader(packet), header)) return error_of(fault);
  return header;
}

// format-spec §4.1
Status check_gop_size(const GopHeader& header, const StreamLimits& limits) {
  if (header.frame_count <= limits.frames_per_gop) return {};
  return stream_error(ErrorCode::kLimitExceeded, "§4.1",
                      {"the GOP has more frames than the stream's head declares"});
}

}  // namespace tvg
