#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"
#include "container/gop_header.hpp"
#include "modes/channels.hpp"
#include "quantization/lattice.hpp"

#include <cstdint>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

namespace tvg {

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

/// Without the channels, which come before.
std::vector<std::uint8_t> write_elp_header(PredictorSet predictors, const Lattice& lattice, Bytes flags);
/// Reads it into `elp`. kUnsupported where a channel is not known that must be.
Status read_elp_header(const GopHeader& header, ElpHeader& elp);

/// What a GOP's headers say of it; all vertices count as flagged.
GopInfo gop_info(const GopHeader& header, const ElpHeader& elp);

}  // namespace tvg
