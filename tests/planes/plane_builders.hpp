#pragma once
#include "entropy/two_ended_coder.hpp"
#include "planes/plane_coder.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

// Gates, flags and planes for tests of PlaneCoder.
namespace tvg::test {

inline constexpr std::array<Predictor, 3> kPredictors = {Predictor::kSpace, Predictor::kTime,
                                                         Predictor::kElp};

using Frame = std::vector<Quad>;  ///< a group of planes: [traversal index], fine lattice, padded

/// Whole gates of any earlier vertices, and now and then a part of one or none.
inline std::vector<Gate> random_gates(std::uint32_t count, std::mt19937& random) {
  std::vector<Gate> gates(count);
  for (std::uint32_t v = 1; v < count; ++v) {
    const auto earlier = [&] { return static_cast<std::uint32_t>(random() % v); };
    const std::uint32_t parts = random() % 8 == 0 ? static_cast<std::uint32_t>(random() % 3) : 3;
    if (parts > 0) gates[v].n = earlier();
    if (parts > 1) gates[v].p = earlier();
    if (parts > 2) gates[v].o = earlier();
  }
  return gates;
}

inline std::vector<std::uint8_t> random_flags(std::size_t count, double share, std::mt19937& random) {
  std::bernoulli_distribution flagged(share);
  std::vector<std::uint8_t> flags(count);
  for (std::uint8_t& flag : flags) flag = flagged(random) ? 1 : 0;
  return flags;
}

/// Indices that wander by up to `largest_move` from frame to frame, from anywhere on the lattice.
template <std::size_t kPlanes = 3>
std::vector<Frame> random_frames(std::size_t vertex_count, std::size_t frame_count, const Lattice& lattice,
                                 const std::vector<std::uint8_t>& flags, std::int32_t largest_move,
                                 std::mt19937& random) {
  const std::int32_t last = static_cast<std::int32_t>((1u << lattice.fine_bits) - 1);
  std::uniform_int_distribution<std::int32_t> anywhere(0, last), move(-largest_move, largest_move);
  std::vector<Frame> frames(frame_count, Frame(vertex_count, Quad{}));
  std::vector<Quad> exact(vertex_count, Quad{});
  for (std::size_t f = 0; f < frame_count; ++f) {
    for (std::size_t v = 0; v < vertex_count; ++v) {
      for (std::size_t plane = 0; plane < kPlanes; ++plane) {
        std::int32_t& index = exact[v][plane];
        index = f == 0 ? anywhere(random) : std::clamp(index + move(random), 0, last);
        const int shift = flags.empty() || flags[v] != 0 ? 0 : lattice.shift();
        frames[f][v][plane] = pad_to_fine(shift_to_coarse(index, shift), shift);
      }
    }
  }
  return frames;
}

/// The predictor of frame f when the others have the given one.
inline Predictor predictor_at(std::size_t f, Predictor others) {
  return f == 0 ? Predictor::kSpace : others;
}

/// One packet for each frame.
template <std::size_t kPlanes = 3>
std::vector<std::vector<std::uint8_t>> encode_frames(const std::vector<Gate>& gates,
                                                     const std::vector<std::uint8_t>& flags,
                                                     const Lattice& lattice, Predictor predictor,
                                                     const std::vector<Frame>& frames) {
  PlaneCoder<kPlanes> coder(Schedule(gates), flags, lattice);
  TwoEndedEncoder encoder;
  std::vector<std::vector<std::uint8_t>> packets;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    coder.next();
    std::copy(frames[f].begin(), frames[f].end(), coder.indices().begin());
    coder.code(encoder, predictor_at(f, predictor));
    packets.push_back(encoder.finish());
  }
  return packets;
}

}  // namespace tvg::test
