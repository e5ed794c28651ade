#pragma once
#include "connectivity/connectivity.hpp"
#include "entropy/residual_models.hpp"
#include "prediction/elp.hpp"
#include "prediction/space.hpp"
#include "prediction/time.hpp"
#include "quantization/lattice.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include <tvg/stream.hpp>

// Predicts and codes the frames of a GOP along the traversal (format-spec §7.5). Written once for both
// directions: with a RangeEncoder the residuals of given indices are written, with a RangeDecoder the indices
// are read.
namespace tvg {

/// One integer per coordinate; the fourth is always zero, so that four lanes can be computed at once.
using Quad = std::array<std::int32_t, 4>;

/// What the frames of one GOP share while they are coded.
class FrameCoder {
 public:
  /// `gates` and `flags` ([traversal index], empty when the lattice is not hybrid) must outlive the coder.
  FrameCoder(std::span<const Gate> gates, std::span<const std::uint8_t> flags, const Lattice& lattice,
             Predictor kind)
      : gates_(gates), flags_(flags), bits_(lattice.fine_bits), shift_(lattice.shift()), kind_(kind) {
    for (auto* plane : {&current_, &previous_, &residuals_}) plane->assign(gates.size(), Quad{});
  }

  /// Indices of the current frame on the fine lattice, [traversal index]; those of vertices without a flag
  /// have been padded. An encoder fills in the whole frame between next_frame() and code().
  std::span<Quad> indices() { return current_; }
  std::span<const Quad> indices() const { return current_; }

  /// Makes the current frame the one before; its indices are then unspecified.
  void next_frame() { std::swap(current_, previous_); }

  /// Codes the current frame. Returns false when a decoded index lies outside its lattice: the stream is
  /// damaged, and the frame must not be used.
  template <class Coder>
  bool code(Coder& coder) {
    const bool first = std::exchange(first_, false);
    if (first || kind_ == Predictor::kSpace) return code_frame<SpacePredictor>(coder, first);
    if (kind_ == Predictor::kTime) return code_frame<TimePredictor>(coder, false);
    return code_frame<ElpPredictor>(coder, false);
  }

 private:
  template <class P, class Coder>
  bool code_frame(Coder& coder, bool first) {
    std::uint32_t outside = 0;
    for (std::size_t v = 0; v < gates_.size(); ++v) {
      outside |= code_vertex<P>(coder, v, first);
      if constexpr (Coder::kDecoding) {
        if (v % 256 == 255 && coder.overrun())
          return false;  // work in proportion to the bytes that are there
      }
    }
    return outside == 0;
  }

  /// Returns bits that are not zero when a coordinate lies outside the lattice.
  template <class P, class Coder>
  std::uint32_t code_vertex(Coder& coder, std::size_t v, bool first) {
    const Gate gate = gates_[v];
    const int shift =
        flags_.empty() || flags_[v] != 0 ? 0 : shift_;  // from the fine lattice to the vertex's own
    const int bits = bits_ - shift;
    std::uint32_t outside = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ResidualContext context{};
      const std::int32_t prediction = gate.o != kNoVertex
                                          ? predict<P>(v, gate, axis, shift, first, context)
                                          : predict_seed<P>(v, gate, axis, shift, first, context);
      const std::int32_t wanted =
          Coder::kDecoding ? 0 : shift_to_coarse(current_[v][axis], shift) - prediction;
      const std::int32_t residual = models_.code(coder, context, wanted);
      const auto index = static_cast<std::uint32_t>(prediction + residual);
      outside |= index >> bits;
      if constexpr (Coder::kDecoding) {
        // What follows a damaged residual is lost; that it stays on the lattice keeps the arithmetic within
        // 32 bits.
        current_[v][axis] = pad_to_fine(static_cast<std::int32_t>(index & ((1u << bits) - 1)), shift);
        residuals_[v][axis] = outside == 0 ? pad_to_fine(residual, shift) : 0;
      } else {
        residuals_[v][axis] = pad_to_fine(residual, shift);
      }
    }
    return outside;
  }

  /// A vertex reached through a gate. Algorithm 2: every neighbour is brought to the vertex's own lattice
  /// first.
  template <class P>
  std::int32_t predict(std::size_t v, const Gate& gate, std::size_t axis, int shift, bool first,
                       ResidualContext& context) const {
    const auto now = [&](std::uint32_t w) { return shift_to_coarse(current_[w][axis], shift); };
    const auto before = [&](std::uint32_t w) { return shift_to_coarse(previous_[w][axis], shift); };
    const Neighbourhood neighbourhood{before(static_cast<std::uint32_t>(v)),
                                      now(gate.n),
                                      now(gate.p),
                                      now(gate.o),
                                      before(gate.n),
                                      before(gate.p),
                                      before(gate.o)};
    const Prediction prediction = P::predict(neighbourhood);
    const std::int32_t at_n = residuals_[gate.n][axis];
    const std::int32_t at_p = residuals_[gate.p][axis];
    const std::int32_t at_o = residuals_[gate.o][axis];
    const std::int32_t own = first ? 0 : residuals_[v][axis];
    const std::int32_t activity = 2 * (std::abs(at_n) + std::abs(at_p)) + std::abs(at_o) + 3 * std::abs(own);
    context = {static_cast<std::uint32_t>(activity >> shift), prediction.lean, at_n + at_p, own};
    return prediction.value;
  }

  /// A vertex without a whole gate: the first ones of a component, and isolated ones.
  template <class P>
  std::int32_t predict_seed(std::size_t v, const Gate& gate, std::size_t axis, int shift, bool first,
                            ResidualContext& context) const {
    const bool has_n = gate.n != kNoVertex;
    const std::size_t n = has_n ? gate.n : v - 1;
    Neighbourhood neighbourhood{};
    neighbourhood.previous = shift_to_coarse(previous_[v][axis], shift);
    neighbourhood.n =
        has_n || v > 0 ? shift_to_coarse(current_[n][axis], shift) : (1 << (bits_ - 1)) >> shift;
    neighbourhood.n_previous = has_n ? shift_to_coarse(previous_[n][axis], shift) : 0;
    const std::int32_t own = first ? 0 : residuals_[v][axis];
    constexpr std::uint32_t kNearActivity = 64;
    constexpr std::uint32_t kFarActivity = 255;
    const std::uint32_t activity =
        first ? (has_n ? kNearActivity : kFarActivity) : 8 * static_cast<std::uint32_t>(std::abs(own));
    context = {activity >> shift, 0, 0, own};
    return P::predict_seed(neighbourhood, has_n);
  }

  std::span<const Gate> gates_;
  std::span<const std::uint8_t> flags_;
  int bits_;
  int shift_;
  Predictor kind_;
  bool first_ = true;
  std::vector<Quad> current_;    ///< [traversal index][axis], fine lattice
  std::vector<Quad> previous_;   ///< the frame before
  std::vector<Quad> residuals_;  ///< of this frame, where coded, else of the frame before; fine lattice
  ResidualModels models_;
};

}  // namespace tvg
