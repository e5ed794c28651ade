#pragma once
#include "modes/animated_decode.hpp"
#include "modes/basis_decode.hpp"
#include "modes/elp_decode.hpp"
#include "modes/lossless_decode.hpp"

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
/// after, but for animated attributes.
class GopDecoder {
  // The one place that knows which modes there are. (std::visit may throw.)
  template <class Self, class Call>
  static decltype(auto) in_mode(Self& self, const Call& call) {
    if (auto* const basis = std::get_if<BasisDecoder>(&self.mode_)) return call(*basis);
    if (auto* const lossless = std::get_if<LosslessDecoder>(&self.mode_)) return call(*lossless);
    return call(*std::get_if<ElpDecoder>(&self.mode_));
  }

 public:
  /// Begins the GOP with this header, which is in a known mode, and whose mesh and, where it names one, whose
  /// plan these are. kOutOfMemory where there is no room; kUnsupported, kMalformed.
  Status begin(const GopHeader& header, std::shared_ptr<const GopMesh> mesh,
               std::shared_ptr<const BasisPlan> plan) {
    if (Status status = begin_mode(header, mesh, std::move(plan)); !status.ok()) return status;
    const Channels& channels = in_mode(*this, [](auto& mode) -> const Channels& { return mode.channels(); });
    return animated_.begin(channels, std::move(mesh));
  }

  /// Decodes the next frame's packet; after an error the rest of the GOP is lost.
  Status take(Bytes packet, Predictor predictor) {
    Status status = in_mode(*this, [&](auto& mode) { return mode.take(packet, predictor); });
    return status.ok() ? animated_.take(packet) : status;
  }
  /// The same, and `bits` becomes what the packet's residuals of x, y and z take. Who calls it is linked with
  /// the coders once more.
  Status take_measured(Bytes packet, Predictor predictor, std::array<double, 3>& bits) {
    Status status = in_mode(*this, [&](auto& mode) { return mode.take_measured(packet, predictor, bits); });
    return status.ok() ? animated_.take(packet) : status;
  }
  /// Compares the digest of all frames decoded with the one the encoder stored.
  Status check_digest(Bytes packet) const {
    Status status = in_mode(*this, [&](auto& mode) { return mode.check_digest(packet); });
    return status.ok() ? animated_.check_digest(packet) : status;
  }

  const GopInfo& info() const {
    return in_mode(*this, [](auto& mode) -> const GopInfo& { return mode.info(); });
  }
  void copy_positions(void* positions, std::size_t stride) const {
    in_mode(*this, [&](auto& mode) { mode.copy_positions(positions, stride); });
  }
  void copy_lattice(std::span<std::int32_t> indices) const {
    in_mode(*this, [&](auto& mode) { mode.copy_lattice(indices); });
  }
  void copy_flags(std::span<std::uint8_t> flags) const {
    in_mode(*this, [&](auto& mode) { mode.copy_flags(flags); });
  }

  /// Null where the GOP is in another mode.
  const BasisDecoder* basis() const { return std::get_if<BasisDecoder>(&mode_); }

  const AnimatedDecoder& animated() const { return animated_; }

 private:
  Status begin_mode(const GopHeader& header, const std::shared_ptr<const GopMesh>& mesh,
                    std::shared_ptr<const BasisPlan> plan) {
    if (header.mode == kModeBasis) {
      if (plan == nullptr) return malformed("§4.5.1", "a GOP in mode basis names other planes than a basis");
      return in<BasisDecoder>().begin(header, std::move(plan));
    }
    if (header.mode == kModeLossless) return in<LosslessDecoder>().begin(header, mesh);
    return in<ElpDecoder>().begin(header, mesh);
  }

  /// The decoder of this mode, which keeps what it has allocated where the GOP before was in it.
  template <class ModeDecoder>
  ModeDecoder& in() {
    auto* const present = std::get_if<ModeDecoder>(&mode_);
    return present != nullptr ? *present : mode_.emplace<ModeDecoder>();
  }

  std::variant<ElpDecoder, BasisDecoder, LosslessDecoder> mode_;
  AnimatedDecoder animated_;
};

}  // namespace tvg
