#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mtl_reader.hpp"
#include "fuzz/require.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

#include <tvg/types.hpp>

/// The input: the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using tvg::fuzz::require;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    std::size_t read = 0;
    for (const tvg::cli::MtlMaterial& material : tvg::cli::parse_mtl("fuzzed", bytes)) {
      require(tvg::is_metadata_text(material.name));
      for (const std::string& line : material.lines) {
        require(!line.empty() && tvg::is_metadata_text(line));
        read += line.size();
      }
    }
    // Bytes that are no text become two each.
    require(read <= 2 * size);
  } catch (const tvg::cli::ImportError&) {
    // An answer as good as any.
  }
  return 0;
}
