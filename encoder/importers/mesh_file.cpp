#include "encoder/importers/mesh_file.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

using PositionBits = std::array<std::uint32_t, 3>;

PositionBits bits_at(const std::vector<float>& positions, std::size_t vertex) {
  return {std::bit_cast<std::uint32_t>(positions[3 * vertex]),
          std::bit_cast<std::uint32_t>(positions[3 * vertex + 1]),
          std::bit_cast<std::uint32_t>(positions[3 * vertex + 2])};
}

const char* format_name(MeshFormat format) {
  switch (format) {
    case MeshFormat::kObj:
      return "an OBJ file";
    case MeshFormat::kPly:
      return "a PLY file";
    case MeshFormat::kOff:
      return "an OFF file";
    case MeshFormat::kStl:
      return "an STL file";
  }
  return "";
}

}  // namespace

void MeshFile::clear() {
  positions.clear();
  faces.clear();
  name.clear();
  polygons = 0;
  polygon_triangles = 0;
}

void read_mesh_file(const std::string& path, MeshFormat format, std::string& buffer, MeshFile& mesh) {
  read_file(path, buffer);
  if (const auto content = recognize_content(buffer)) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("{} is {}, not {}", path, *content, format_name(format)));
  }
  switch (format) {
    case MeshFormat::kObj:
      parse_obj(path, buffer, mesh);
      break;
    case MeshFormat::kPly:
      parse_ply(path, buffer, mesh);
      break;
    case MeshFormat::kOff:
      parse_off(path, buffer, mesh);
      break;
    case MeshFormat::kStl:
      parse_stl(path, buffer, mesh);
      break;
  }
}

std::optional<std::size_t> apply_weld(const Weld& weld, MeshFile& mesh) {
  // Vertices are numbered by first appearance, so a vertex never lies behind the corner that is looked at.
  std::uint32_t vertices_seen = 0;
  for (std::size_t corner = 0; corner < weld.vertex_of_point.size(); ++corner) {
    const std::uint32_t vertex = weld.vertex_of_point[corner];
    if (vertex == vertices_seen) {
      std::copy_n(mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * corner), 3,
                  mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * std::size_t{vertex}));
      ++vertices_seen;
    } else if (bits_at(mesh.positions, vertex) != bits_at(mesh.positions, corner)) {
      return corner;
    }
  }
  mesh.positions.resize(3 * std::size_t{weld.vertex_count()});
  for (Face& face : mesh.faces) {
    for (std::uint32_t& index : face) index = weld.vertex_of_point[index];
  }
  return std::nullopt;
}

}  // namespace tvg::cli
