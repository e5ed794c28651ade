#pragma once
#include "plane_builders.hpp"

#include <cstdint>
#include <random>
#include <vector>

namespace tvg::test {

/// What every operation of Lanes gives for numbers of all sizes.
inline std::vector<std::int32_t> trace_lanes(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto number = [&random] { return static_cast<std::int32_t>(random()) >> (random() % 30 + 2); };
  const auto quad = [&number] { return Quad{number(), number(), number(), number()}; };
  std::vector<std::int32_t> trace;
  const auto note = [&trace](Lanes lanes) {
    const Quad whole = lanes.quad();
    for (std::size_t i = 0; i < whole.size(); ++i) {
      trace.push_back(whole[i]);
      trace.push_back(lanes[i]);
    }
  };
  for (int round = 0; round < 200; ++round) {
    const Lanes a(quad()), b(quad()), small(Quad{-1, 0, 1, static_cast<std::int32_t>(random() % 20) - 10});
    const std::int32_t limit = static_cast<std::int32_t>(random() % 5) - 2;
    const int bits = static_cast<int>(random() % 25);
    for (const Lanes x : {a, b, small}) {
      for (const Lanes y :
           {x + small, x - small, x & b, x ^ b, x >> bits, small << bits, x > limit, x < limit, abs(x),
            half(x), twice(small), thrice(small), clamp<1>(x), clamp<2>(x), clamp<7>(x)})
        note(y);
    }
  }
  note(Lanes());
  note(Lanes::all(7));
  return trace;
}

/// The packets of random groups of planes.
inline std::vector<std::vector<std::uint8_t>> trace_planes(std::uint32_t seed) {
  std::mt19937 random(seed);
  const int fine = 2 + static_cast<int>(random() % 23);
  const Lattice lattice{{}, 1, fine, fine - static_cast<int>(random() % static_cast<unsigned>(fine))};
  const std::vector<Gate> gates = random_gates(120, random);
  const std::vector<std::uint8_t> flags =
      lattice.hybrid() ? random_flags(gates.size(), 0.4, random) : std::vector<std::uint8_t>();
  const std::vector<Frame> frames = random_frames(gates.size(), 4, lattice, flags, 1 << (fine / 2), random);
  return encode_frames(gates, flags, lattice, kPredictors[seed % 3], frames);
}

}  // namespace tvg::test
