#include "container/gop_header.hpp"

#include "base/stream_error.hpp"

#include <algorithm>
#include <cmath>

namespace tvg {

std::vector<std::uint8_t> write_gop_header(const GopHeader& header) {
  ByteWriter writer;
  writer.u8(0);  // mode 0: frames on the lattice
  writer.u8(header.predictor);
  writer.u8(header.fine_bits);
  writer.u8(header.coarse_bits);
  for (const double coordinate : header.origin) writer.f64(coordinate);
  writer.f64(header.step);
  writer.varint(header.first_frame);
  writer.varint(header.frame_count);
  writer.bytes(header.flags);
  return writer.take();
}

// format-spec §4.5.1
Result<GopHeader> read_gop_header(Bytes packet) {
  ByteReader reader(packet);
  GopHeader header{};
  const std::uint8_t mode = reader.u8();
  header.predictor = reader.u8();
  header.fine_bits = reader.u8();
  header.coarse_bits = reader.u8();
  for (double& coordinate : header.origin) coordinate = reader.f64();
  header.step = reader.f64();
  header.first_frame = reader.varint();
  const std::uint64_t frame_count = reader.varint();
  if (!reader.ok()) return malformed("§4.5.1", "the GOP's header is too short");
  if (mode != 0 || header.predictor > static_cast<std::uint8_t>(Predictor::kElp)) {
    return malformed("§4.5.1", "the GOP's mode or predictor is unknown");
  }
  constexpr std::uint8_t kMaxBits = 24;
  if (header.coarse_bits < 1 || header.coarse_bits > header.fine_bits || header.fine_bits > kMaxBits) {
    return malformed("§4.5.1", "the GOP's bits are out of range");
  }
  const bool finite =
      std::all_of(header.origin.begin(), header.origin.end(), [](double x) { return std::isfinite(x); });
  if (!finite || !std::isfinite(header.step) || header.step <= 0) {
    return malformed("§4.5.1", "the GOP's lattice has no finite origin or no positive step");
  }
  if (frame_count == 0 || frame_count > 0xFFFFFFFF || header.first_frame > (std::uint64_t{1} << 62)) {
    return malformed("§4.5.1", "the GOP's frame numbers are out of range");
  }
  header.frame_count = static_cast<std::uint32_t>(frame_count);
  header.flags = reader.bytes(reader.left());
  if (header.fine_bits == header.coarse_bits && !header.flags.empty()) {
    return malformed("§4.5.1", "a GOP with one lattice carries flags");
  }
  return header;
}

// format-spec §4.1
Status check_gop_size(const GopHeader& header, const StreamLimits& limits) {
  if (header.frame_count <= limits.frames_per_gop) return {};
  return stream_error(ErrorCode::kLimitExceeded, "§4.1",
                      {"the GOP has more frames than the stream's head declares"});
}

}  // namespace tvg
