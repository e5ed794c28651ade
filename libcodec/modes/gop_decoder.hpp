#pragma once
#include "modes/elp_decode.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <variant>

#include <tvg/decoder.hpp>

namespace tvg {

/// Decodes one GOP in whatever mode it is, packet by packet (format-spec §4.5). Allocates in begin() and not
/// after.
class GopDecoder {
 public:
  /// Begins the GOP with this header, which is in a known mode. kOutOfMemory where there is no room;
  /// kUnsupported, kMalformed.
  Status begin(const GopHeader& header, std::shared_ptr<const GopMesh> mesh) {
    return mode().begin(header, std::move(mesh));
  }

  /// Decodes the next frame's packet; after an error the rest of the GOP is lost.
  Status take(Bytes packet, Predictor predictor) { return mode().take(packet, predictor); }
  /// The same, and `bits` becomes what the packet's residuals of x, y and z take. Who calls it is linked with
  /// the coder of planes once more.
  Status take_measured(Bytes packet, Predictor predictor, std::array<double, 3>& bits) {
    return mode().take_measured(packet, predictor, bits);
  }
  /// Compares the digest of all frames decoded with the one the encoder stored.
  Status check_digest(Bytes packet) const { return mode().check_digest(packet); }

  const GopInfo& info() const { return mode().info(); }
  void copy_positions(void* positions, std::size_t stride) const { mode().copy_positions(positions, stride); }
  void copy_lattice(std::span<std::int32_t> indices) const { mode().copy_lattice(indices); }
  void copy_flags(std::span<std::uint8_t> flags) const { mode().copy_flags(flags); }

 private:
  // The one place that knows which mode the GOP is in.
  ElpDecoder& mode() { return *std::get_if<ElpDecoder>(&mode_); }
  const ElpDecoder& mode() const { return *std::get_if<ElpDecoder>(&mode_); }

  std::variant<ElpDecoder> mode_;
};

}  // namespace tvg
