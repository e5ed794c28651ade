#pragma once
#include "entropy/range_coder.hpp"
#include "planes/coefficient_coder.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

namespace tvg::test {

/// A pyramid of levels of growing size, each vertex with neighbours of earlier turns and any weights.
inline Pyramid random_pyramid(std::uint32_t vertices, std::uint32_t neighbours, std::mt19937& random) {
  Pyramid pyramid;
  pyramid.neighbours = neighbours;
  for (std::uint32_t turn = 0; turn < vertices; ++turn) {
    pyramid.order.push_back(turn);
    pyramid.level.push_back(static_cast<std::uint8_t>(std::bit_width(turn) / 2));
    const std::uint32_t count = std::min(turn, static_cast<std::uint32_t>(random()) % (neighbours + 1));
    pyramid.count.push_back(static_cast<std::uint8_t>(count));
    for (std::uint32_t i = 0; i < neighbours; ++i) {
      pyramid.neighbour.push_back(i < count ? static_cast<std::uint32_t>(random() % turn) : 0);
      pyramid.weight.push_back(i < count ? static_cast<std::int16_t>(i == 0 ? 20000 : random() % 65536)
                                         : std::int16_t{0});
    }
  }
  pyramid.levels = pyramid.level.empty() ? 0 : pyramid.level.back() + 1u;
  return pyramid;
}

/// The wanted coefficients as residuals, whatever is predicted.
struct Wanted {
  const std::vector<Quad>& values;

  template <class Models, class Bit, class Forecast>
  Quad operator()(const Models&, const Bit&, const Forecast& forecast) const {
    Quad residuals{};
    for (std::size_t j = 0; j < forecast.count; ++j)
      residuals[j] = (values[forecast.vertex][j] >> forecast.shift) - forecast.rounded[j];
    return residuals;
  }
};

/// Groups of planes of any size, coded; the same for every way of compiling the coder.
inline std::vector<std::vector<std::uint8_t>> trace_coefficients(std::uint32_t seed) {
  std::mt19937 random(seed);
  const Pyramid pyramid = random_pyramid(400, 4 + seed % 13, random);
  std::vector<std::uint8_t> flags;
  const int nested = static_cast<int>(seed % 3);
  for (std::uint32_t v = 0; nested > 0 && v < 400; ++v) flags.push_back(random() % 2);
  CoefficientCoder coder(pyramid, flags, nested);
  RangeEncoder encoder;
  std::vector<std::vector<std::uint8_t>> groups;
  for (int group = 0; group < 6; ++group) {
    std::vector<Quad> wanted(400), values(400);
    for (Quad& quad : wanted) {
      for (std::int32_t& value : quad)
        value = static_cast<std::int32_t>(random() % 40000 >> (3 * group)) - (20000 >> (3 * group));
    }
    coder.code(encoder, values, group == 5 ? 2 : 4, Wanted{wanted});
    groups.push_back(encoder.finish());
  }
  return groups;
}

}  // namespace tvg::test
