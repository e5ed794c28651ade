#pragma once
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
#include <utility>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Predicts and codes a group of one to four planes along a schedule, time after time (format-spec §7.5).
/// Written once for both directions: with a RangeEncoder the residuals of given indices are written, with a
/// RangeDecoder the indices are read. The planes of a group are coded together, vertex by vertex, and share
/// their models; `Context` chooses these.
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
    const std::vector<Quad>& planes;
    int shift;

    Lanes operator()(std::uint32_t vertex) const { return Lanes(planes[vertex]) >> shift; }
  };

  template <class P, class Coder>
  bool code_planes(Coder& coder, bool alone) {
    return flags_.empty() ? code_planes<P, false>(coder, alone) : code_planes<P, true>(coder, alone);
  }

  template <class P, bool kHybrid, class Coder>
  bool code_planes(Coder& coder, bool alone) {
    std::uint32_t outside = 0;
    for (std::size_t turn = 0; turn < schedule_.size(); ++turn) {
      const Scheduled v = schedule_[turn];
      const int shift = kHybrid && flags_[v.vertex] == 0 ? nested_ : 0;
      outside |= v.whole() ? code_gated<P, kHybrid>(coder, v, shift) : code_seed<P>(coder, v, shift, alone);
      if constexpr (Coder::kDecoding) {
        if (turn % 256 == 255 && coder.overrun())
          return false;  // work in proportion to the bytes that are there
      }
    }
    return outside == 0;
  }

  /// A vertex with a whole gate. Algorithm 2: every neighbour is brought to the vertex's own lattice first,
  /// `shift` bits from the fine one.
  template <class P, bool kHybrid, class Coder>
  std::uint32_t code_gated(Coder& coder, const Scheduled& v, int shift) {
    const View now{current_, shift}, before{previous_, shift}, residuals{residuals_, 0};
    const Prediction<Lanes> prediction = P::predict(v, now, before);
    if constexpr (kHybrid) {
      const GateLattices lattices{
          nested_, shift, {flags_[v.gate.n] != 0, flags_[v.gate.p] != 0, flags_[v.gate.o] != 0}};
      const GroupChoice choice =
          Context::template on_two_lattices<P>(v, residuals, prediction.lean, lattices, now, before);
      return code_vertex(coder, v.vertex, prediction.value, choice, shift);
    } else {
      return code_vertex(coder, v.vertex, prediction.value,
                         Context::on_one_lattice(v, residuals, prediction.lean), 0);
    }
  }

  template <class P, class Coder>
  [[gnu::noinline]] std::uint32_t code_seed(Coder& coder, const Scheduled& v, int shift, bool alone) {
    const View now{current_, shift}, before{previous_, shift}, residuals{residuals_, 0};
    const Lanes prediction = P::predict_seed(v, now, before, middle() >> shift);
    return code_vertex(coder, v.vertex, prediction, Context::of_seed(v, residuals, shift, alone), shift);
  }

  /// Codes a vertex's residuals; `prediction` is on its own lattice. Returns bits that are not zero when an
  /// index lies outside that lattice.
  template <class Coder>
  [[gnu::always_inline]] std::uint32_t code_vertex(Coder& coder, std::uint32_t v, Lanes prediction,
                                                   const GroupChoice& choice, int shift) {
    const Lanes wanted = (Lanes(current_[v]) >> shift) - prediction;
    Quad coded{};
    for (std::size_t plane = 0; plane < kPlanes; ++plane)
      coded[plane] = models_.code(coder, choice.of(plane), Coder::kDecoding ? 0 : wanted[plane]);
    // Whole quads are stored, not their parts: the next vertex loads them whole, at once.
    const Lanes residuals(coded[0], coded[1], coded[2], coded[3]);
    const Lanes index = prediction + residuals;
    const Lanes inside = index & Lanes::all((1 << (bits_ - shift)) - 1);
    const Quad differs = (index ^ inside).quad();
    const auto outside = static_cast<std::uint32_t>(differs[0] | differs[1] | differs[2] | differs[3]);
    // What follows a damaged residual is lost. Staying on the lattice keeps the arithmetic within 32 bits.
    if constexpr (Coder::kDecoding) current_[v] = (inside << shift).quad();
    residuals_[v] = outside == 0 ? (residuals << shift).quad() : Quad{};
    return outside;
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
