#pragma once
#include "base/byte_io.hpp"
#include "base/checksum.hpp"
#include "base/stream_error.hpp"
#include "container/gop_header.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

// What the frames of a GOP are made of, whatever its mode (format-spec §4.5.1 to §4.5.3).
namespace tvg {

/// Positions (format-spec §3.5, §4.5.1).
inline constexpr std::uint64_t kPositionsChannel = 1;
/// The values of an animated attribute of this number.
constexpr std::uint64_t channel_of_attribute(std::uint64_t attribute) {
  return 2 + 2 * attribute;
}

/// The channels of a GOP's frames, by their numbers; the first is positions.
struct Channels {
  static constexpr std::size_t kMost = 256;

  std::array<std::uint64_t, kMost> numbers = {kPositionsChannel};
  std::size_t count = 1;

  /// Where among them this one is; kMost where it is not.
  std::size_t find(std::uint64_t number) const {
    const auto end = numbers.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::find(numbers.begin(), end, number);
    return found == end ? kMost : static_cast<std::size_t>(found - numbers.begin());
  }
};

/// What a header says of a GOP in this mode before the mode's own fields are read.
GopInfo gop_info_of(const GopHeader& header, Mode mode);

/// As the fields of a mode begin: positions, and these.
void write_channels(ByteWriter& writer, std::span<const std::uint64_t> others);
/// Reads them; all but the first may be unknown. kUnsupported where one is not known that must be.
Fault read_channels(ByteReader& reader, Channels& channels);

/// The piece of a frame's packet that holds positions (§4.5.2); the pieces of all others fit.
Result<Bytes> positions_piece(const Channels& channels, Bytes packet);
/// The piece of the channel at this place among them, of a packet whose pieces fit.
Bytes piece_at(const Channels& channels, std::size_t place, Bytes packet);

/// A channel beside positions, as it is written.
struct EncodedChannel {
  std::uint64_t number = 0;
  std::vector<std::vector<std::uint8_t>> pieces;  ///< [frame]
  std::uint64_t digest = 0;
};

/// A frame's packet (§4.5.2), where others are other channels.
std::vector<std::uint8_t> write_pieces(std::vector<std::uint8_t> positions,
                                       std::span<const EncodedChannel> others, std::size_t frame);
/// The digest packet of a GOP (§4.5.3).
std::vector<std::uint8_t> write_digest(std::uint64_t positions, std::span<const EncodedChannel> others);
/// The digest of the channel at this place in a digest packet that has those of all channels.
std::uint64_t digest_at(std::size_t place, Bytes packet);
/// Compares the digest of positions in a digest packet, which has those of all channels, with that of what
/// was decoded.
Status compare_digest(const Channels& channels, Bytes packet, std::uint64_t decoded);

}  // namespace tvg
