#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"

#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

// Modes (format-spec §4.5.1).
inline constexpr auto kModeElp = static_cast<std::uint64_t>(Mode::kElp);
inline constexpr auto kModeBasis = static_cast<std::uint64_t>(Mode::kBasis);
inline constexpr auto kModeLossless = static_cast<std::uint64_t>(Mode::kLossless);

constexpr bool is_known_mode(std::uint64_t mode) {
  return mode <= kModeLossless;
}
/// What is wrong with a GOP in another, which may be valid.
inline constexpr Fault kUnknownMode{"§4.5.1", "the GOP is in a mode that this decoder does not know",
                                    ErrorCode::kUnsupported};

/// §4.5.1: the first packet of a GOP, as far as it does not depend on the mode.
struct GopHeader {
  static constexpr std::size_t kMostPlanes = 256;

  std::uint32_t mesh = 0;         ///< id of the mesh
  std::uint64_t first_frame = 0;  ///< number of the first frame in the sequence it was encoded from
  std::uint32_t frame_count = 0;
  std::uint32_t packet_count = 0;  ///< behind this one
  Bytes planes;                    ///< ids of planes, four bytes each
  std::uint64_t mode = kModeElp;
  Bytes fields;  ///< those of the mode

  std::size_t plane_count() const { return planes.size() / 4; }
};
std::vector<std::uint8_t> write_gop_header(const GopHeader& header);
Result<GopHeader> read_gop_header(Bytes packet);

/// Whether a GOP is as short as the head says.
Status check_gop_size(const GopHeader& header, const StreamLimits& limits);

}  // namespace tvg
