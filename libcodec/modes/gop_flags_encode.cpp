#include "modes/gop_flags_encode.hpp"

#include "quantization/flag_coder.hpp"

namespace tvg {

std::vector<std::uint8_t> flags_in_traversal_order(const GopInput& input, const CodedMesh& mesh) {
  std::vector<std::uint8_t> flags;
  if (!input.lattice.hybrid()) return flags;
  flags.resize(mesh.order.size());
  for (std::size_t v = 0; v < flags.size(); ++v) flags[v] = input.flags[mesh.order[v]];
  return flags;
}

std::vector<std::uint8_t> encode_flags(const CodedMesh& mesh, std::span<const std::uint8_t> flags) {
  if (flags.empty()) return {};
  std::vector<std::uint8_t> coded(flags.begin(), flags.end());
  RangeEncoder coder;
  code_flags(coder, mesh.gates, coded);
  return coder.finish();
}

}  // namespace tvg
