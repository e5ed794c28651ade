#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "fuzz/require.hpp"
#include "geometry/property_fault.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// One reader of mesh files, the function that TVG_FUZZ_PARSER names.

namespace {

using tvg::fuzz::require;

void check(const tvg::cli::MeshFile& mesh, std::size_t bytes) {
  for (const tvg::Face& face : mesh.faces) {
    for (const std::uint32_t index : face) require(index < mesh.vertex_count());
  }
  for (const float value : mesh.positions) require(std::isfinite(value));
  // No count of the file is taken at its word: every number has bytes of its own.
  require(mesh.positions.size() <= bytes && mesh.faces.size() <= bytes);
}

}  // namespace

/// The input: the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string name = "fuzzed";
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  tvg::cli::MeshFile mesh;
  try {
    tvg::cli::TVG_FUZZ_PARSER(name, bytes, mesh);
  } catch (const tvg::cli::ImportError& error) {
    require(std::string_view(error.what()).find(name) != std::string_view::npos);
    return 0;
  }
  check(mesh, size);
  const tvg::Mesh faces{static_cast<std::uint32_t>(mesh.vertex_count()), mesh.faces};
  require(!tvg::property_fault(faces, {mesh.attributes, mesh.parts, mesh.face_parts, mesh.polygons}));
  // STL has corners, which are then welded.
  const tvg::Weld weld = tvg::weld_positions(mesh.positions);
  tvg::cli::apply_weld(weld, mesh);
  check(mesh, size);
  return 0;
}
