#pragma once
#include "base/bits.hpp"
#include "connectivity/connectivity.hpp"
#include "planes/residual_context.hpp"
#include "planes/residual_models.hpp"
#include "prediction/elp.hpp"
#include "prediction/space.hpp"
#include "prediction/time.hpp"
#include "quantization/lattice.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tvg/types.hpp>

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
      : gates_(gates),
        flags_(flags),
        bits_(lattice.fine_bits),
        shift_(lattice.shift()),
        kind_(kind),
        models_(lattice.hybrid() ? kGateKindCount : 1) {
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
  /// Four coordinates at once: element-wise + - * >> ^ and comparisons, which yield -1 for true.
  using Lanes [[gnu::vector_size(16)]] = std::int32_t;

  template <class P, class Coder>
  bool code_frame(Coder& coder, bool first) {
    std::uint32_t outside = 0;
    for (std::size_t v = 0; v < gates_.size(); ++v) {
      const Gate& gate = gates_[v];
      if (gate.o == kNoVertex) {
        outside |= code_seed<P>(coder, v, gate, first);
      } else if (flags_.empty()) {
        outside |= code_uniform<P>(coder, v, gate);
      } else {
        outside |= code_hybrid<P>(coder, v, gate);
      }
      if constexpr (Coder::kDecoding) {
        if (v % 256 == 255 && coder.overrun())
          return false;  // work in proportion to the bytes that are there
      }
    }
    return outside == 0;
  }

  /// Codes one coordinate; `prediction` is on the vertex's own lattice. Returns bits that are not zero when
  /// the index lies outside that lattice.
  template <class Coder>
  [[gnu::always_inline]] std::uint32_t code_coordinate(Coder& coder, std::size_t v, std::size_t axis,
                                                       std::int32_t prediction, const ModelChoice& models,
                                                       int shift) {
    coder.begin_coordinate(axis);
    const std::int32_t wanted = Coder::kDecoding ? 0 : shift_to_coarse(current_[v][axis], shift) - prediction;
    const std::int32_t residual = models_.code(coder, models, wanted);
    const auto index = static_cast<std::uint32_t>(prediction + residual);
    const std::uint32_t outside = index >> (bits_ - shift);
    if constexpr (Coder::kDecoding) {
      // What follows a damaged residual is lost. Staying on the lattice keeps the arithmetic within 32 bits.
      const auto inside = static_cast<std::int32_t>(index & ((1u << (bits_ - shift)) - 1));
      current_[v][axis] = pad_to_fine(inside, shift);
    }
    residuals_[v][axis] = outside == 0 ? pad_to_fine(residual, shift) : 0;
    return outside;
  }

  /// A vertex reached through a gate when there is one lattice: four lanes at once. code_hybrid() says the
  /// same of one coordinate at a time.
  template <class P, class Coder>
  std::uint32_t code_uniform(Coder& coder, std::size_t v, const Gate& gate) {
    const auto lanes = [](const Quad& quad) { return bits_as<Lanes>(quad); };
    const auto size = [](Lanes x) { return (x ^ (x >> 31)) - (x >> 31); };
    const Prediction<Lanes> prediction = P::template predict<Lanes>(
        {lanes(previous_[v]), lanes(current_[gate.n]), lanes(current_[gate.p]), lanes(current_[gate.o]),
         lanes(previous_[gate.n]), lanes(previous_[gate.p]), lanes(previous_[gate.o])});
    const Lanes at_n = lanes(residuals_[gate.n]);
    const Lanes at_p = lanes(residuals_[gate.p]);
    const Lanes own = lanes(residuals_[v]);
    const Lanes activity = 2 * (size(at_n) + size(at_p)) + size(lanes(residuals_[gate.o])) + 3 * size(own);
    const Lanes lean = 3 * (2 - (prediction.lean > 0) - (prediction.lean > 1) + (prediction.lean < 0) +
                            (prediction.lean < -1));
    const Lanes ends = at_n + at_p;
    const Lanes first = lean + 1 - (ends > 0) + (ends < 0);
    const Lanes second = lean + 1 - (own > 0) + (own < 0);
    const Lanes given = lanes(current_[v]);
    std::array<std::int32_t, 3> residual;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const ModelChoice models{kOneLattice, static_cast<std::uint32_t>(activity[axis]),
                               static_cast<std::uint32_t>(first[axis]),
                               static_cast<std::uint32_t>(second[axis])};
      coder.begin_coordinate(axis);
      residual[axis] =
          models_.code(coder, models, Coder::kDecoding ? 0 : given[axis] - prediction.value[axis]);
    }
    // Whole quads are stored, not their parts: the next vertex loads them whole, at once.
    const Lanes residuals = {residual[0], residual[1], residual[2], 0};
    const Lanes index = prediction.value + residuals;
    const Lanes inside = index & ((1 << bits_) - 1);
    const Lanes differs = index ^ inside;
    const std::uint32_t outside = static_cast<std::uint32_t>(differs[0] | differs[1] | differs[2]);
    if constexpr (Coder::kDecoding) current_[v] = bits_as<Quad>(inside);
    residuals_[v] = outside == 0 ? bits_as<Quad>(residuals) : Quad{};
    return outside;
  }

  /// A vertex reached through a gate. Algorithm 2: every neighbour is brought to the vertex's own lattice
  /// first.
  template <class P, class Coder>
  std::uint32_t code_hybrid(Coder& coder, std::size_t v, const Gate& gate) {
    const std::array<bool, 3> fine = {flags_[gate.n] != 0, flags_[gate.p] != 0, flags_[gate.o] != 0};
    const int fine_count = int{fine[0]} + int{fine[1]} + int{fine[2]};
    const int shift = flags_[v] != 0 ? 0 : shift_;  // from the fine lattice to the vertex's own
    const std::size_t set =
        shift == 0 ? (fine_count == 3 ? kOneLattice : kFineAmongNone + static_cast<std::size_t>(fine_count))
                   : (fine_count == 0 ? kCoarse : kCoarseMixed);
    const bool pulled = P::kUsesTime && shift == 0 && fine_count < 3;
    std::uint32_t outside = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto now = [&](std::size_t w) { return shift_to_coarse(current_[w][axis], shift); };
      const auto before = [&](std::size_t w) { return shift_to_coarse(previous_[w][axis], shift); };
      const Neighbourhood<std::int32_t> around{before(v),      now(gate.n),    now(gate.p),   now(gate.o),
                                               before(gate.n), before(gate.p), before(gate.o)};
      const Prediction<std::int32_t> prediction = P::predict(around);
      const CoordinateFacts facts{
          {residuals_[gate.n][axis], residuals_[gate.p][axis], residuals_[gate.o][axis]},
          residuals_[v][axis],
          prediction.lean};
      ModelChoice models = choose_models(set, facts, shift);
      if (pulled) {
        const std::array<std::int32_t, 3> motion = {
            around.n - around.n_previous, around.p - around.p_previous, around.o - around.o_previous};
        const std::int32_t pull = coarse_pull(motion, fine, prediction.lean) >> (shift_ > 2 ? shift_ - 2 : 0);
        models = choose_models_pulled(set, facts, pull);
      }
      outside |= code_coordinate(coder, v, axis, prediction.value, models, shift);
    }
    return outside;
  }

  /// A vertex without a whole gate: the first ones of a component, and isolated ones.
  template <class P, class Coder>
  std::uint32_t code_seed(Coder& coder, std::size_t v, const Gate& gate, bool first) {
    constexpr std::int32_t kNearActivity = 64;
    constexpr std::int32_t kFarActivity = 255;
    const bool has_n = gate.n != kNoVertex;
    const int shift = flags_.empty() || flags_[v] != 0 ? 0 : shift_;
    std::uint32_t outside = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Neighbourhood<std::int32_t> around{};
      around.previous = shift_to_coarse(previous_[v][axis], shift);
      around.n = shift_to_coarse(1 << (bits_ - 1), shift);
      if (has_n || v > 0) {
        const std::size_t n = has_n ? gate.n : v - 1;
        around.n = shift_to_coarse(current_[n][axis], shift);
        around.n_previous = shift_to_coarse(previous_[n][axis], shift);
      }
      const std::int32_t own = residuals_[v][axis];
      const std::int32_t activity = first ? (has_n ? kNearActivity : kFarActivity) : 8 * std::abs(own);
      ModelChoice models = choose_models(kOneLattice, {{}, own, 0}, 0);
      models.activity = static_cast<std::uint32_t>(activity >> shift);
      outside |= code_coordinate(coder, v, axis, P::predict_seed(around, has_n), models, shift);
    }
    return outside;
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
