#include "encoder/importers/import_error.hpp"
#include "encoder/importers/vertex_weights.hpp"
#include "fuzz/require.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

/// The input: a byte, 0 for a text and others for a NumPy array, and the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string name = data[0] == 0 ? "fuzzed.txt" : "fuzzed.npy";
  const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  try {
    const std::vector<double> weights = tvg::cli::parse_vertex_weights(name, bytes);
    tvg::fuzz::require(weights.size() <= bytes.size());
    for (const double weight : weights) tvg::fuzz::require(std::isfinite(weight));
  } catch (const tvg::cli::ImportError&) {
    // An answer as good as any.
  }
  return 0;
}
