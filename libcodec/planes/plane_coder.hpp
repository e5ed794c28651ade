#pragma once
#include "entropy/kept_coder.hpp"
#include "planes/elp_context.hpp"
#include "planes/lanes.hpp"
#include "planes/residual_models.hpp"
#include "prediction/elp.hpp"
#include "prediction/schedule.hpp"
#include "prediction/space.hpp"
#include "prediction/time.hpp"
#include "quantization/lattice.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Predicts and codes a group of one to four planes along a schedule, time after time (format-spec §7.5).
/// Written once for both directions: with a TwoEndedEncoder the residuals of given indices are written, with
/// a TwoEndedDecoder the indices are read. The planes of a group are coded together, vertex by vertex, and
/// share their models; `Context` chooses these.
template <std::size_t kPlanes, class Context = ElpContext>
class PlaneCoder {
  static_assert(kPlanes >= 1 && kPlanes <= std::tuple_size_v<Quad>);

 public:
  /// What a coder allocates, all of it when it is made: for each vertex, and beside that.
  static constexpr std::size_t kBytesPerVertex = 3 * sizeof(Quad);
  static constexpr std::size_t kMostModelBytes = ResidualModels::bytes(Context::set_count(true));

  /// What `schedule` refers to and `flags` ([vertex], empty when the lattice is not hybrid) must outlive the
  /// coder.
  PlaneCoder(const Schedule& schedule, std::span<const std::uint8_t> flags, const Lattice& lattice)
      : schedule_(schedule),
        flags_(flags),
        bits_(lattice.fine_bits),
        nested_(lattice.shift()),
        models_(Context::set_count(lattice.hybrid())) {
    for (auto* planes : {&current_, &previous_, &residuals_}) planes->assign(schedule.size(), Quad{});
  }

  /// Indices of the current planes on the fine lattice, [vertex]; those of vertices without a flag have been
  /// padded. An encoder fills in all of them between next() and code().
  std::span<Quad> indices() { return current_; }
  std::span<const Quad> indices() const { return current_; }

  /// Makes the current planes the reference planes; the current ones are then unspecified.
  void next() { std::swap(current_, previous_); }

  /// Says that the current planes are coded otherwise.
  void pass() { alone_ = false; }

  /// Codes the current planes, the first time with a predictor that needs no reference planes. Returns false
  /// when a decoded index lies outside its lattice: the stream is damaged, and the planes must not be used.
  template <class Coder>
  bool code(Coder& coder, Predictor predictor) {
    const bool alone = std::exchange(alone_, false);
    if (predictor == Predictor::kSpace) return code_planes<SpacePredictor>(coder, alone);
    if (predictor == Predictor::kTime) return code_planes<TimePredictor>(coder, alone);
    return code_planes<ElpPredictor>(coder, alone);
  }

 private:
  /// Planes as they look on one of the lattices.
  struct View {
    const Quad* planes;
    int shift;

    Lanes operator()(std::uint32_t vertex) const { return Lanes(planes[vertex]) >> shift; }
  };

  template <class P, class Coder>
  bool code_planes(Coder& coder, bool alone) {
    // One lattice is two that never differ, but for the predictor of most frames there is a loop apart.
    if constexpr (kOfMostFrames<P>) {
      if (flags_.empty()) return code_planes<P, false>(coder, alone);
    }
    return code_planes<P, true>(coder, alone);
  }

  /// The others' loops are made for size.
  template <class P>
  static constexpr bool kOfMostFrames = std::is_same_v<P, ElpPredictor>;

  /// What a pass over the planes needs all the time, apart from what its stores may change.
  struct Pass {
    Quad* current;
    const Quad* previous;
    Quad* residuals;
    const std::uint8_t* flags;  ///< null when all vertices are fine
    int bits, nested;
    bool alone;  ///< there are no reference planes

    bool fine(std::uint32_t vertex) const { return flags == nullptr || flags[vertex] != 0; }
  };

  template <class P, bool kHybrid, class Coder>
  bool code_planes(Coder& given, bool alone) {
    const Pass pass{current_.data(),
                    previous_.data(),
                    residuals_.data(),
                    flags_.empty() ? nullptr : flags_.data(),
                    bits_,
                    nested_,
                    alone};
    const Schedule schedule = schedule_;
    KeptCoder<Coder> coder(given);
    std::uint32_t outside = 0;
    bool whole = true;
    for (std::size_t turn = 0; turn < schedule.size() && whole; ++turn) {
      const Scheduled v = schedule[turn];
      const int shift = kHybrid && !pass.fine(v.vertex) ? pass.nested : 0;
      if (v.whole()) [[likely]] {
        outside |= code_gated<P, kHybrid>(coder, pass, v, shift);
      } else {
        outside |= apart(coder, [&](Coder& cold) { return code_seed<P>(cold, pass, turn, shift); });
      }
      if constexpr (Coder::kDecoding) {
        if (turn % 256 == 255 && coder.overrun())
          whole = false;  // work in proportion to the bytes that are there
      }
    }
    give_back(given, coder);
    return whole && outside == 0;
  }

  /// A vertex with a whole gate. Algorithm 2: every neighbour is brought to the vertex's own lattice first,
  /// `shift` bits from the fine one.
  template <class P, bool kHybrid, class Coder>
  [[gnu::always_inline]] std::uint32_t code_gated(Coder& coder, const Pass& pass, const Scheduled& v,
                                                  int shift) {
    const View now{pass.current, shift}, before{pass.previous, shift}, residuals{pass.residuals, 0};
    const Prediction<Lanes> prediction = P::predict(v, now, before);
    if constexpr (kHybrid) {
      const GateLattices lattices{
          pass.nested, shift, {pass.fine(v.gate.n), pass.fine(v.gate.p), pass.fine(v.gate.o)}};
      const GroupChoice choice =
          Context::template on_two_lattices<P>(v, residuals, prediction.lean, lattices, now, before);
      if constexpr (!kOfMostFrames<P>)
        return code_one_vertex(coder, pass, v.vertex, prediction.value, choice, shift);
      return code_vertex(coder, pass, v.vertex, prediction.value, choice, shift);
    } else {
      return code_vertex(coder, pass, v.vertex, prediction.value,
                         Context::on_one_lattice(v, residuals, prediction.lean), 0);
    }
  }

  template <class P, class Coder>
  std::uint32_t code_seed(Coder& coder, const Pass& pass, std::size_t turn, int shift) {
    const Scheduled v = schedule_[turn];
    const View now{pass.current, shift}, before{pass.previous, shift}, residuals{pass.residuals, 0};
    const Lanes prediction = P::predict_seed(v, now, before, middle() >> shift);
    return code_one_vertex(coder, pass, v.vertex, prediction,
                           Context::of_seed(v, residuals, shift, pass.alone), shift);
  }

  template <class Coder>
  [[gnu::noinline]] std::uint32_t code_one_vertex(Coder& coder, const Pass& pass, std::uint32_t v,
                                                  Lanes prediction, const GroupChoice& choice, int shift) {
    return code_vertex(coder, pass, v, prediction, choice, shift);
  }

  /// Codes a vertex's residuals; `prediction` is on its own lattice. Returns bits that are not zero when an
  /// index lies outside that lattice.
  template <class Coder>
  [[gnu::always_inline]] std::uint32_t code_vertex(Coder& coder, const Pass& pass, std::uint32_t v,
                                                   Lanes prediction, const GroupChoice& choice, int shift) {
    const Lanes wanted = (Lanes(pass.current[v]) >> shift) - prediction;
    const Lanes residuals = models_.template code<kPlanes>(coder, choice, wanted);
    const Lanes index = prediction + residuals;
    const Lanes inside = index & Lanes::all((1 << (pass.bits - shift)) - 1);
    const bool outside = any(index ^ inside);
    // What follows a damaged residual is lost. Staying on the lattice keeps the arithmetic within 32 bits.
    if constexpr (Coder::kDecoding) pass.current[v] = (inside << shift).quad();
    pass.residuals[v] = outside ? Quad{} : (residuals << shift).quad();
    return outside ? 1 : 0;
  }

  /// The middle of the fine lattice in all planes of the group.
  Lanes middle() const {
    Quad middle{};
    for (std::size_t plane = 0; plane < kPlanes; ++plane) middle[plane] = 1 << (bits_ - 1);
    return Lanes(middle);
  }

  Schedule schedule_;
  std::span<const std::uint8_t> flags_;
  int bits_;                     ///< of the fine lattice
  int nested_;                   ///< bits between the two lattices
  bool alone_ = true;            ///< there are no reference planes yet
  std::vector<Quad> current_;    ///< [vertex][plane], fine lattice
  std::vector<Quad> previous_;   ///< the reference planes
  std::vector<Quad> residuals_;  ///< of this time, where coded, else of the time before; fine lattice
  ResidualModels models_;
};

}  // namespace tvg
