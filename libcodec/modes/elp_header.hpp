#pragma once
#include "base/byte_io.hpp"
#include "container/gop_header.hpp"
#include "quantization/lattice.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Positions: the only channel so far (format-spec §3.5, §4.5.1).
inline constexpr std::uint64_t kPositionsChannel = 1;

/// The channels of a GOP's frames, by their numbers; the first is positions.
struct Channels {
  static constexpr std::size_t kMost = 256;

  std::array<std::uint64_t, kMost> numbers = {kPositionsChannel};
  std::size_t count = 1;
};

/// The predictors that frames of a GOP may have.
class PredictorSet {
 public:
  PredictorSet() = default;
  explicit PredictorSet(std::uint8_t bits) : bits_(bits) {}

  void add(Predictor predictor) { bits_ = static_cast<std::uint8_t>(bits_ | bit(predictor)); }
  bool has(Predictor predictor) const { return (bits_ & bit(predictor)) != 0; }
  /// As the header has it: bit p stands for predictor p.
  std::uint8_t bits() const { return bits_; }

 private:
  static constexpr std::uint8_t bit(Predictor predictor) {
    return static_cast<std::uint8_t>(1u << static_cast<unsigned>(predictor));
  }

  std::uint8_t bits_ = 0;
};

/// The fields of a GOP's header in mode elp (format-spec §4.5.1).
struct ElpHeader {
  Channels channels;
  PredictorSet predictors;
  Lattice lattice;
  Bytes flags;  ///< coded flags; empty unless the lattice is hybrid
};

std::vector<std::uint8_t> write_elp_header(PredictorSet predictors, const Lattice& lattice, Bytes flags);
/// Reads it into `elp`. kUnsupported where a channel is not known that must be.
Status read_elp_header(const GopHeader& header, ElpHeader& elp);

/// The piece of a frame's packet that holds positions (§4.5.2).
Result<Bytes> positions_piece(const Channels& channels, Bytes packet);

/// The digest packet of a GOP (§4.5.3): that of positions.
std::vector<std::uint8_t> write_digest(std::uint64_t positions);
/// The digest of positions from a digest packet, which has those of all channels.
Result<std::uint64_t> read_digest(const Channels& channels, Bytes packet);

/// What a GOP's headers say of it; all vertices count as flagged.
GopInfo gop_info(const GopHeader& header, const ElpHeader& elp);

}  // namespace tvg
