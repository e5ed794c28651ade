#pragma once
#include "entropy/adaptive_models.hpp"

#include <cstdint>
#include <vector>

namespace tvg {

/// Every number that models and mixtures give while two models learn pseudo-random symbols.
inline std::vector<std::uint32_t> trace_models(std::uint32_t seed) {
  std::vector<std::uint32_t> trace;
  const auto next = [&seed] { return (seed = seed * 1664525u + 1013904223u) >> 8; };
  const std::uint32_t symbols = 2 + next() % 15;
  AdaptiveSymbol a(static_cast<int>(symbols)), b;
  for (int step = 0; step < 300; ++step) {
    const SymbolMixture mixture(a, b);
    for (std::uint32_t s = 0; s <= AdaptiveSymbol::kMaxSymbols; ++s)
      trace.push_back(SymbolMixture::cumulative(a, b, s));
    for (int probe = 0; probe < 8; ++probe) {
      const std::uint32_t range = (1u << 15) + next() % (1u << 15);
      const SymbolMixture::Found found = mixture.find(range, next() % range);
      trace.insert(trace.end(), {found.symbol, found.interval.low, found.interval.high});
      if (probe == 0) a.adapt(found.goals);
    }
    const std::uint32_t symbol = next() % 4 == 0 ? next() % symbols : 0;
    a.adapt(symbol);
    if (next() % 2 == 0) b.adapt(next() % AdaptiveSymbol::kMaxSymbols);
  }
  return trace;
}

}  // namespace tvg
