#pragma once
#include "base/checksum.hpp"
#include "modes/gop_mesh.hpp"
#include "modes/lossless_header.hpp"
#include "planes/ordered_coder.hpp"
#include "planes/reals.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg {

/// Decodes a GOP in mode lossless, packet by packet (format-spec §7.9). Allocates in begin() and not after.
class LosslessDecoder {
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
  /// [vertex][xyz]: the bits of float32 coordinates, ordered().
  void copy_lattice(std::span<std::int32_t> numbers) const;
  /// [vertex], all 1.
  void copy_flags(std::span<std::uint8_t> flags) const;

 private:
  /// The bytes of a frame's positions.
  Result<Bytes> open(Bytes packet, Predictor predictor) const;
  template <class Coder>
  Status decode(Coder& coder);

  std::shared_ptr<const GopMesh> mesh_;
  GopInfo info_;
  Channels channels_;
  std::vector<Reals> values_;  ///< [traversal index] of the frame
  std::optional<OrderedCoder> along_pyramid_;
  Hasher digest_;
};

}  // namespace tvg
