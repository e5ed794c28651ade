#pragma once
#include "base/checksum.hpp"
#include "connectivity/mesh_coder.hpp"
#include "container/gop_header.hpp"
#include "planes/frame_coder.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg {

/// Decodes one GOP, packet by packet (format-spec §4.5, §7). Allocates in begin() and not after.
class GopDecoder {
 public:
  /// Begins the GOP with this header. `mesh` must outlive it. kOutOfMemory where there is no room.
  Status begin(const GopHeader& header, const CodedMesh& mesh);

  /// Decodes the next frame's packet; after an error the rest of the GOP is lost.
  Status decode_frame(Bytes packet);
  /// The same, and `bits` becomes what the packet's residuals of x, y and z take.
  Status decode_frame(Bytes packet, std::array<double, 3>& bits);

  /// Compares the digest of all frames decoded with the one the encoder stored.
  Status check_digest(Bytes packet) const;

  const GopInfo& info() const { return info_; }
  void copy_positions(void* positions, std::size_t stride) const;
  void copy_lattice(std::span<std::int32_t> indices) const;
  void copy_flags(std::span<std::uint8_t> flags) const;

 private:
  template <class Coder>
  Status decode_residuals(Coder& coder);
  bool flagged(std::size_t v) const { return flags_.empty() || flags_[v] != 0; }

  const CodedMesh* mesh_ = nullptr;
  GopInfo info_;
  Lattice lattice_;
  std::vector<std::uint8_t> flags_;  ///< [traversal index]; empty when the lattice is not hybrid
  std::optional<FrameCoder> coder_;
  Hasher digest_;
};

}  // namespace tvg
