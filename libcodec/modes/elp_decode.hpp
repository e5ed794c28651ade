#pragma once
#include "base/checksum.hpp"
#include "modes/elp.hpp"
#include "modes/elp_header.hpp"
#include "modes/gop_mesh.hpp"
#include "planes/pyramid_coder.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg {

/// Decodes a GOP in mode elp, packet by packet (format-spec §7). Allocates in begin() and not after.
class ElpDecoder {
 public:
  /// Begins the GOP with this header. kOutOfMemory where there is no room; kUnsupported, kMalformed.
  Status begin(const GopHeader& header, std::shared_ptr<const GopMesh> mesh);

  /// Decodes the next frame's packet; after an error the rest of the GOP is lost.
  Status take(Bytes packet, Predictor predictor);
  /// The same, and `bits` becomes what the residuals of x, y and z take of the packet.
  Status take_measured(Bytes packet, Predictor predictor, std::array<double, 3>& bits);

  /// Compares the digest of all frames taken with the one the encoder stored.
  Status check_digest(Bytes packet) const;

  const GopInfo& info() const { return info_; }
  const Channels& channels() const { return channels_; }
  /// The frame taken last: vertex v's x, y, z as float32 at `positions` + v * `stride`.
  void copy_positions(void* positions, std::size_t stride) const;
  /// [vertex][xyz], each on its vertex's own lattice.
  void copy_lattice(std::span<std::int32_t> indices) const;
  /// [vertex], 0 or 1.
  void copy_flags(std::span<std::uint8_t> flags) const;

 private:
  /// The bytes of a frame's positions.
  Result<Bytes> open(Bytes packet, Predictor predictor) const;
  template <class Coder>
  Status decode(Coder& coder, Predictor predictor);
  bool flagged(std::size_t v) const { return flags_.empty() || flags_[v] != 0; }

  std::shared_ptr<const GopMesh> mesh_;
  GopInfo info_;
  Channels channels_;
  Lattice lattice_;
  std::vector<std::uint8_t> flags_;  ///< [traversal index]; empty when the lattice is not hybrid
  std::vector<std::uint32_t> turn_;  ///< [vertex drawn]: its traversal index
  PredictorSet predictors_;
  std::optional<PositionCoder> positions_;  ///< holds the frame
  std::optional<PyramidCoder> along_pyramid_;
  std::uint32_t frames_taken_ = 0;
  Hasher digest_;
};

}  // namespace tvg
