#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <tvg/error.hpp>

namespace tvg {

/// Version of the format this library writes. A reader takes the same major version and any minor one up to
/// its own.
inline constexpr std::uint16_t kFormatMajor = 0;
inline constexpr std::uint16_t kFormatMinor = 1;

/// How frames are predicted (format-spec §7.2).
enum class Predictor : std::uint8_t {
  kSpace = 0,  ///< the parallelogram of the gate in the same frame
  kTime = 1,   ///< the same vertex in the frame before
  kElp = 2,    ///< Extended Lorenzo: the parallelogram of the motion (the paper's Eq. 9)
};

/// Upper bounds a stream declares for itself (format-spec §4.1).
struct StreamLimits {
  std::uint32_t vertices = 0;        ///< of any mesh
  std::uint32_t faces = 0;           ///< of any mesh
  std::uint32_t frames_per_gop = 0;  ///< of any GOP
  std::uint32_t packet_bytes = 0;    ///< of any packet
  std::uint64_t decoder_memory = 0;  ///< bytes, as decoder_memory_needed() gives them

  bool operator==(const StreamLimits&) const = default;
};

/// The memory a decoder of this library may need for a stream with these limits, in bytes (format-spec §8.2).
constexpr std::uint64_t decoder_memory_needed(const StreamLimits& limits) {
  return (std::uint64_t{1} << 20) + 160 * std::uint64_t{limits.vertices} + 96 * std::uint64_t{limits.faces} +
         4 * std::uint64_t{limits.packet_bytes};
}

/// What the head of a stream says.
struct StreamHead {
  std::uint16_t major = kFormatMajor;
  std::uint16_t minor = kFormatMinor;
  StreamLimits limits;
};

/// One line of a stream's index (format-spec §4.6).
struct IndexEntry {
  enum class Kind : std::uint8_t { kMesh = 0, kGop = 1 };

  Kind kind = Kind::kGop;
  std::uint64_t offset = 0;       ///< of the chunk's first byte, from the first byte of the stream
  std::uint32_t frame_count = 0;  ///< frames of a GOP, 0 for a mesh

  bool operator==(const IndexEntry&) const = default;
};

}  // namespace tvg
