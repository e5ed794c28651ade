#include "connectivity/connectivity.hpp"
#include "connectivity/vertex_order.hpp"
#include "fuzz/require.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using tvg::fuzz::require;

void check(const tvg::Connectivity& connectivity, std::uint32_t vertex_count, std::uint32_t face_count) {
  require(connectivity.gates.size() == vertex_count && connectivity.faces.size() == face_count);
  for (const tvg::Face& face : connectivity.faces) {
    for (const std::uint32_t v : face) require(v < vertex_count);
  }
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    const tvg::Gate& gate = connectivity.gates[v];
    require(gate.n < v || gate.n == tvg::kNoVertex);
    require(gate.p == tvg::kNoVertex || (gate.p < v && gate.n != tvg::kNoVertex));
    require(gate.o == tvg::kNoVertex || (gate.o < v && gate.p != tvg::kNoVertex));
  }
}

}  // namespace

/// The input: vertex count (2 bytes, little-endian), face count (2 bytes), bytes of connectivity (2 bytes),
/// these, and the vertex order in what is left.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 6) return 0;
  const auto word = [data](std::size_t i) {
    return std::uint32_t{data[i]} | std::uint32_t{data[i + 1]} << 8;
  };
  const std::uint32_t vertex_count = word(0), face_count = word(2);
  const std::span<const std::uint8_t> rest(data + 6, size - 6);
  const std::size_t length = word(4) < rest.size() ? word(4) : rest.size();
  const auto connectivity = tvg::decode_connectivity(rest.first(length), vertex_count, face_count);
  std::vector<tvg::Gate> gates(vertex_count);
  if (connectivity) {
    check(*connectivity, vertex_count, face_count);
    gates = connectivity->gates;
  }
  const auto order = tvg::decode_order(rest.subspan(length), gates);
  if (!order) return 0;
  require(order->size() == vertex_count);
  std::vector<bool> used(vertex_count, false);
  for (const std::uint32_t v : *order) {
    require(v < vertex_count && !used[v]);
    used[v] = true;
  }
  return 0;
}
