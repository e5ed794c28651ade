#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

// The conformance streams: small, and together they use every part of the format.
namespace tvg::conformance {

struct ConformanceStream {
  std::string_view name;  ///< of the file, without .tvg
  std::string_view what;  ///< what it is there for
  std::vector<std::uint8_t> (*make)();
  /// Whether `make` gives the same bytes on every machine. Where it fits a basis it does not: how a compiler
  /// rounds and sums what is fitted decides what is stored, though never what the stored bytes decode to.
  bool same_everywhere = true;
  std::uint32_t lods = 0;  ///< coarse meshes that its mesh has
};

/// Every conformance stream there is.
const std::vector<ConformanceStream>& conformance_streams();

/// The stream of that name; ends the program when there is none.
std::vector<std::uint8_t> make_stream(std::string_view name);

}  // namespace tvg::conformance
