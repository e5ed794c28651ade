#pragma once
#include "base/checksum.hpp"
#include "basis/basis_sums.hpp"
#include "basis/row_coder.hpp"
#include "container/gop_header.hpp"
#include "modes/basis_plan.hpp"
#include "modes/channels.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg {

/// Decodes a GOP in mode basis, packet by packet (format-spec §7.8). A packet yields the rows of its frame,
/// which is little work; what costs is the frame made of them, and that is done when it is asked for.
/// Allocates in begin() and not after.
class BasisDecoder {
 public:
  /// Begins the GOP with this header, whose plan and its mesh are these. kOutOfMemory where there is no room;
  /// kUnsupported, kMalformed.
  Status begin(const GopHeader& header, std::shared_ptr<const BasisPlan> plan);

  Status take(Bytes packet, Predictor predictor);
  /// The same, and `bits` becomes a third of the packet for each axis: one helps to tell the others.
  Status take_measured(Bytes packet, Predictor predictor, std::array<double, 3>& bits);
  Status check_digest(Bytes packet) const;

  const GopInfo& info() const { return info_; }
  const Channels& channels() const { return channels_; }
  void copy_positions(void* positions, std::size_t stride) const;
  /// The nearest multiples of the step.
  void copy_lattice(std::span<std::int32_t> indices) const;
  void copy_flags(std::span<std::uint8_t> flags) const;

  /// Number 0 before begin().
  BasisInfo basis() const;
  /// The coefficients of components 4 * group and the three behind it, [vertex][4], 0 where there is none.
  /// Number is float or, where none is larger, std::int16_t.
  template <class Number>
  void copy_planes(std::size_t group, std::span<Number> values) const;
  /// What a position is the sum of: [1 + component][xyz], first what is added to all.
  void copy_rows(std::span<float> rows) const;

 private:
  std::shared_ptr<const BasisPlan> plan_;
  GopInfo info_;
  Channels channels_;
  std::optional<RowCoder> row_coder_;
  std::vector<std::int32_t> rows_;  ///< [row][xyz] of the frame
  BasisSums sums_;                  ///< of the frame
  Hasher digest_;
};

}  // namespace tvg
