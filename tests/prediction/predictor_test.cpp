#include "planes/plane_coder.hpp"
#include "prediction/elp.hpp"
#include "prediction/schedule.hpp"
#include "prediction/space.hpp"
#include "prediction/time.hpp"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace tvg {
namespace {

/// What predictors see of a plane.
auto view(const std::array<std::int32_t, 4>& plane) {
  return [&plane](std::uint32_t w) { return plane.at(w); };
}

/// One plane at two times: n, p, o and v.
struct Around {
  std::array<std::int32_t, 4> then, now;

  template <class P>
  std::int32_t predict() const {
    return P::predict(kVertex, view(now), view(then)).value;
  }
  template <class P>
  std::int32_t predict_seed(std::uint32_t n, std::uint32_t nearest) const {
    const Scheduled seed{3, {n, kNoVertex, kNoVertex}, nearest};
    return P::predict_seed(seed, view(now), view(then), 1024);
  }

 private:
  static constexpr Scheduled kVertex{3, {0, 1, 2}, 0};
};

// n, p, o went from 40, 60, 45 to 43, 58, 49; v was at 50.
constexpr Around kExample{{40, 60, 45, 50}, {43, 58, 49, 0}};

TEST(Predictors, ElpIsEquation9WorkedByHand) {
  // 50 + (43 - 40) + (58 - 60) - (49 - 45) = 47.
  EXPECT_EQ(kExample.predict<ElpPredictor>(), 47);
}

TEST(Predictors, ElpFollowsATranslationExactly) {
  const Around moved{{40, 60, 45, 50}, {47, 67, 52, 0}};
  EXPECT_EQ(moved.predict<ElpPredictor>(), 57);
}

TEST(Predictors, SpaceIsTheParallelogramOfTheFrame) {
  EXPECT_EQ(kExample.predict<SpacePredictor>(), 43 + 58 - 49);
}

TEST(Predictors, TimeIsTheVertexItselfInTheFrameBefore) {
  EXPECT_EQ(kExample.predict<TimePredictor>(), 50);
}

TEST(Predictors, SeedsFollowTheOneNeighbourTheyHave) {
  EXPECT_EQ(kExample.predict_seed<ElpPredictor>(0, 0), 50 + 3);
  EXPECT_EQ(kExample.predict_seed<ElpPredictor>(kNoVertex, 2), 50);
  EXPECT_EQ(kExample.predict_seed<TimePredictor>(0, 0), 50);
  EXPECT_EQ(kExample.predict_seed<SpacePredictor>(0, 0), 43);
}

TEST(Predictors, SeedsWithoutANeighbourFollowTheVertexBeforeInSpace) {
  EXPECT_EQ(kExample.predict_seed<SpacePredictor>(kNoVertex, 2), 49);
  EXPECT_EQ(kExample.predict_seed<SpacePredictor>(kNoVertex, kNoVertex), 1024);
}

TEST(Schedule, FollowsTheTraversalAndItsGates) {
  const std::vector<Gate> gates = {{}, {0, kNoVertex, kNoVertex}, {}, {0, 1, 2}};
  const Schedule schedule{gates};
  ASSERT_EQ(schedule.size(), 4u);
  const std::vector<std::uint32_t> nearest = {kNoVertex, 0, 1, 0};
  for (std::uint32_t turn = 0; turn < 4; ++turn) {
    EXPECT_EQ(schedule[turn].vertex, turn);
    EXPECT_EQ(schedule[turn].gate, gates[turn]);
    EXPECT_EQ(schedule[turn].nearest, nearest[turn]);
    EXPECT_EQ(schedule[turn].whole(), turn == 3);
  }
}

/// Takes the place of an encoder and notes the residuals it is given, as long as none needs the escape.
class SpyCoder {
 public:
  static constexpr bool kDecoding = false;

  SpyCoder& lane(std::size_t plane) {
    plane_ = plane;
    return *this;
  }
  std::uint32_t code(AdaptiveSymbol& /*a*/, AdaptiveSymbol& /*b*/, std::uint32_t symbol) {
    notes_.push_back({symbol == 15, static_cast<std::int32_t>(symbol) - 7});
    return symbol;
  }
  bool code(AdaptiveBit& /*model*/, bool bit) { return bit; }
  std::uint32_t code_raw(std::uint32_t value, int count) {
    Note& note = notes_[notes_.size() - 3 + plane_];
    note.residual = note.residual * (1 << count) + static_cast<std::int32_t>(value);
    return value;
  }

  /// Of the vertex coded last.
  std::array<std::int32_t, 3> last_residuals() const {
    std::array<std::int32_t, 3> residuals{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Note& note = notes_[notes_.size() - 3 + axis];
      EXPECT_FALSE(note.escaped);
      residuals[axis] = note.residual;
    }
    return residuals;
  }

 private:
  struct Note {
    bool escaped = false;
    std::int32_t residual = 0;
  };
  std::vector<Note> notes_;
  std::size_t plane_ = 0;  ///< that is coded
};

/// Four vertices, the last one reached through the gate n = 0, p = 1, o = 2; all three axes alike.
struct Example {
  std::vector<std::uint8_t> flags;            ///< of n, p, o, v
  std::array<std::int32_t, 4> first, second;  ///< indices of n, p, o, v, each on its own lattice
};

/// Residuals of the last vertex in both frames, on 13 and 11 bits.
std::array<std::array<std::int32_t, 3>, 2> residuals_of(const Example& example, Predictor predictor) {
  const std::vector<Gate> gates = {{}, {0, kNoVertex, kNoVertex}, {0, 1, kNoVertex}, {0, 1, 2}};
  const Lattice lattice{{}, 1, 13, 11};
  PlaneCoder<3> frames(Schedule(gates), example.flags, lattice);
  std::array<std::array<std::int32_t, 3>, 2> residuals{};
  for (std::size_t f = 0; f < 2; ++f) {
    frames.next();
    for (std::size_t v = 0; v < 4; ++v) {
      const std::int32_t own = (f == 0 ? example.first : example.second)[v];
      const std::int32_t index = example.flags[v] != 0 ? own : pad_to_fine(own, 2);
      frames.indices()[v] = {index, index, index, 0};
    }
    SpyCoder spy;
    EXPECT_TRUE(frames.code(spy, f == 0 ? Predictor::kSpace : predictor));
    residuals[f] = spy.last_residuals();
  }
  return residuals;
}

std::array<std::int32_t, 3> all(std::int32_t value) {
  return {value, value, value};
}

// n coarse at 100, then 101 (400 and 404 on the fine lattice); p and o fine; v fine.
const Example kPadded = {{0, 1, 1, 1}, {100, 410, 405, 407}, {101, 412, 406, 409}};

TEST(Algorithm2, CoarseNeighbourOfAnImportantVertexIsPaddedInSpace) {
  EXPECT_EQ(residuals_of(kPadded, Predictor::kSpace)[0], all(407 - (400 + 410 - 405)));
  EXPECT_EQ(residuals_of(kPadded, Predictor::kSpace)[1], all(409 - (404 + 412 - 406)));
}

TEST(Algorithm2, CoarseNeighbourOfAnImportantVertexIsPaddedInEquation9) {
  // 407 + (404 - 400) + (412 - 410) - (406 - 405) = 412.
  EXPECT_EQ(residuals_of(kPadded, Predictor::kElp)[0], all(407 - (400 + 410 - 405))) << "space-only at first";
  EXPECT_EQ(residuals_of(kPadded, Predictor::kElp)[1], all(409 - 412));
}

// p and o fine (410 to 413 is 102 to 103 on the coarse lattice, 405 to 403 is 101 to 100), n and v coarse.
const Example kShifted = {{0, 1, 1, 0}, {100, 410, 405, 101}, {101, 413, 403, 103}};

TEST(Algorithm2, FineNeighbourOfAnotherVertexIsShiftedInSpace) {
  EXPECT_EQ(residuals_of(kShifted, Predictor::kSpace)[0], all(101 - (100 + 102 - 101)));
  EXPECT_EQ(residuals_of(kShifted, Predictor::kSpace)[1], all(103 - (101 + 103 - 100)));
}

TEST(Algorithm2, FineNeighbourOfAnotherVertexIsShiftedInEquation9) {
  // 101 + (101 - 100) + (103 - 102) - (100 - 101) = 104.
  EXPECT_EQ(residuals_of(kShifted, Predictor::kElp)[1], all(103 - 104));
}

TEST(Algorithm2, TimeStaysOnTheVertexsOwnLattice) {
  EXPECT_EQ(residuals_of(kShifted, Predictor::kTime)[1], all(2));
  EXPECT_EQ(residuals_of(kPadded, Predictor::kTime)[1], all(2));
}

TEST(Algorithm2, NothingIsPaddedOrShiftedAmongEquals) {
  const Example fine = {{1, 1, 1, 1}, {401, 410, 405, 407}, {403, 413, 406, 409}};
  EXPECT_EQ(residuals_of(fine, Predictor::kElp)[1], all(409 - (407 + 2 + 3 - 1)));
  const Example coarse = {{0, 0, 0, 0}, {401, 410, 405, 407}, {403, 413, 406, 409}};
  EXPECT_EQ(residuals_of(coarse, Predictor::kElp)[1], all(409 - (407 + 2 + 3 - 1)));
}

}  // namespace
}  // namespace tvg
