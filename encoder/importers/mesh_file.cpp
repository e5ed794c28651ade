#include "encoder/importers/mesh_file.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

using PositionBits = std::array<std::uint32_t, 3>;

PositionBits bits_at(const std::vector<float>& positions, std::size_t vertex) {
  return {std::bit_cast<std::uint32_t>(positions[3 * vertex]),
          std::bit_cast<std::uint32_t>(positions[3 * vertex + 1]),
          std::bit_cast<std::uint32_t>(positions[3 * vertex + 2])};
}

std::size_t hash_of(const PositionBits& bits) {
  std::uint64_t hash = 0;
  for (const std::uint32_t word : bits) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
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

Weld find_weld(const std::vector<float>& corner_positions) {
  const std::size_t corner_count = corner_positions.size() / 3;
  Weld weld;
  weld.vertex_of_corner.reserve(corner_count);
  std::vector<std::uint32_t> table(std::bit_ceil(2 * corner_count + 1), kNoVertex);
  std::vector<std::size_t> first_corner;
  for (std::size_t corner = 0; corner < corner_count; ++corner) {
    const PositionBits bits = bits_at(corner_positions, corner);
    std::size_t slot = hash_of(bits) & (table.size() - 1);
    while (table[slot] != kNoVertex && bits_at(corner_positions, first_corner[table[slot]]) != bits) {
      slot = (slot + 1) & (table.size() - 1);
    }
    if (table[slot] == kNoVertex) {
      table[slot] = weld.vertex_count++;
      first_corner.push_back(corner);
    }
    weld.vertex_of_corner.push_back(table[slot]);
  }
  return weld;
}

std::optional<std::size_t> apply_weld(const Weld& weld, MeshFile& mesh) {
  // Vertices are numbered by first appearance, so a vertex never lies behind the corner that is looked at.
  std::uint32_t vertices_seen = 0;
  for (std::size_t corner = 0; corner < weld.vertex_of_corner.size(); ++corner) {
    const std::uint32_t vertex = weld.vertex_of_corner[corner];
    if (vertex == vertices_seen) {
      std::copy_n(mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * corner), 3,
                  mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * std::size_t{vertex}));
      ++vertices_seen;
    } else if (bits_at(mesh.positions, vertex) != bits_at(mesh.positions, corner)) {
      return corner;
    }
  }
  mesh.positions.resize(3 * std::size_t{weld.vertex_count});
  for (Face& face : mesh.faces) {
    for (std::uint32_t& index : face) index = weld.vertex_of_corner[index];
  }
  return std::nullopt;
}

}  // namespace tvg::cli
