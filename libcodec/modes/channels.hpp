#pragma once
#include "base/byte_io.hpp"
#include "base/checksum.hpp"
#include "base/stream_error.hpp"
#include "container/gop_header.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

// What the frames of a GOP are made of, whatever its mode (format-spec §4.5.1 to §4.5.3).
namespace tvg {

/// Positions: the only channel so far (format-spec §3.5, §4.5.1).
inline constexpr std::uint64_t kPositionsChannel = 1;

/// The channels of a GOP's frames, by their numbers; the first is positions.
struct Channels {
  static constexpr std::size_t kMost = 256;

  std::array<std::uint64_t, kMost> numbers = {kPositionsChannel};
  std::size_t count = 1;
};

/// What a header says of a GOP in this mode before the mode's own fields are read.
GopInfo gop_info_of(const GopHeader& header, Mode mode);

/// As the fields of a mode begin.
void write_channels(ByteWriter& writer);
/// Reads them; all but the first may be unknown. kUnsupported where one is not known that must be.
Fault read_channels(ByteReader& reader, Channels& channels);

/// The piece of a frame's packet that holds positions (§4.5.2).
Result<Bytes> positions_piece(const Channels& channels, Bytes packet);

/// The digest packet of a GOP (§4.5.3): that of positions.
std::vector<std::uint8_t> write_digest(std::uint64_t positions);
/// Compares the digest of positions in a digest packet, which has those of all channels, with that of what
/// was decoded.
Status compare_digest(const Channels& channels, Bytes packet, std::uint64_t decoded);

}  // namespace tvg
