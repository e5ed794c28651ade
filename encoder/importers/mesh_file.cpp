#include "encoder/importers/mesh_file.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

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
  polygons.clear();
  name.clear();
  attributes.clear();
  parts.clear();
  face_parts.clear();
  material_files.clear();
  texture_files.clear();
  misplaced.clear();
  notes.clear();
  finer_than_float = false;
}

float MeshFile::relative(double coordinate, std::size_t axis) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (std::abs(coordinate) > kLargest) return std::numeric_limits<float>::infinity();
  if (double{static_cast<float>(coordinate)} != coordinate) finer_than_float = true;
  return static_cast<float>(coordinate - (*origin)[axis]);
}

void MeshBuilder::finish(const std::string& file, const std::string& hint) {
  if (mesh_.faces.empty()) throw EmptyInputError(fmt::format("{} has no faces{}", file, hint));
  if (short_faces_ > 0) {
    mesh_.notes.push_back(fmt::format("{} with fewer than three corners left out",
                                      short_faces_ == 1 ? "1 face" : fmt::format("{} faces", short_faces_)));
  }
  if (mesh_.misplaced.empty()) return;
  std::vector<bool> misplaced(mesh_.vertex_count(), false);
  for (const std::uint32_t vertex : mesh_.misplaced) misplaced[vertex] = true;
  for (const Face& face : mesh_.faces) {
    for (const std::uint32_t vertex : face) {
      if (!misplaced[vertex]) continue;
      throw ImportError(ErrorCode::kInvalidInput,
                        fmt::format("{}: vertex {} has a coordinate that is NaN or infinite{}",
                                    vertex == mesh_.misplaced[0] ? first_bad_place_ : file, vertex,
                                    ", and a face uses it"));
    }
  }
  for (const std::uint32_t vertex : mesh_.misplaced)
    std::fill_n(mesh_.positions.begin() + static_cast<std::ptrdiff_t>(3 * std::size_t{vertex}), 3, 0.0F);
  const std::size_t count = mesh_.misplaced.size();
  mesh_.notes.push_back(fmt::format(
      "{} with a coordinate that is NaN or infinite, which no face uses, left where the frame before has {} "
      "(in the first frame at the origin)",
      count == 1 ? "1 vertex" : fmt::format("{} vertices", count), count == 1 ? "it" : "them"));
}

namespace {

void parse(const std::string& path, MeshFormat format, const std::string& bytes, MeshFile& mesh) {
  switch (format) {
    case MeshFormat::kObj:
      parse_obj(path, bytes, mesh);
      break;
    case MeshFormat::kPly:
      parse_ply(path, bytes, mesh);
      break;
    case MeshFormat::kOff:
      parse_off(path, bytes, mesh);
      break;
    case MeshFormat::kStl:
      parse_stl(path, bytes, mesh);
      break;
  }
}

/// The step of float32 at the largest of the box's coordinates.
double float_step(const BoundingBox& box) {
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.low()[axis]), std::abs(box.high()[axis])});
  return largest > 0 ? std::ldexp(1, std::ilogb(largest) - 23) : 0;
}

BoundingBox box_of(const MeshFile& mesh) {
  BoundingBox box;
  box.extend(mesh.positions);
  return box;
}

/// The middle of a box, in few digits: of the decimal place of the box's extent.
Origin origin_near(const BoundingBox& box) {
  const double unit = std::pow(10.0, std::floor(std::log10(box.largest_extent())));
  Origin origin = box.center();
  for (double& coordinate : origin) {
    // Through text, because a multiple of 0.01 in double has digits behind it that nobody wrote.
    const int digits = std::clamp(static_cast<int>(-std::log10(unit)), 0, 17);
    coordinate =
        std::strtod(fmt::format("{:.{}f}", std::round(coordinate / unit) * unit, digits).c_str(), nullptr);
    if (coordinate == 0) coordinate = 0;  // not -0
  }
  return origin;
}

}  // namespace

void read_mesh_file(const std::string& path, MeshFormat format, std::string& buffer, MeshFile& mesh) {
  read_file(path, buffer);
  if (const auto content = recognize_content(buffer)) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("{} is {}, not {}", path, *content, format_name(format)));
  }
  parse(path, format, buffer, mesh);
}

void read_located_mesh(const std::string& path, MeshFormat format, std::string& buffer, MeshFile& mesh) {
  constexpr double kFewestSteps = 1000;
  if (mesh.origin) {
    if (is_zero(*mesh.origin)) mesh.origin.reset();
    return read_mesh_file(path, format, buffer, mesh);
  }
  read_mesh_file(path, format, buffer, mesh);
  const BoundingBox rough = box_of(mesh);
  const double step = float_step(rough);
  if (rough.largest_extent() >= kFewestSteps * step) return;
  // What float32 made of the mesh tells where it is, not how large: that is seen from nearby.
  mesh.origin = rough.center();
  parse(path, format, buffer, mesh);
  const BoundingBox box = box_of(mesh);
  const bool finer = mesh.finer_than_float && box.largest_extent() > 0;
  if (finer) {
    BoundingBox placed;
    placed.extend(box.low()[0] + rough.center()[0], box.low()[1] + rough.center()[1],
                  box.low()[2] + rough.center()[2]);
    placed.extend(box.high()[0] + rough.center()[0], box.high()[1] + rough.center()[1],
                  box.high()[2] + rough.center()[2]);
    mesh.origin = origin_near(placed);
    parse(path, format, buffer, mesh);
    mesh.notes.push_back(fmt::format(
        "float32 steps are {:.3g} so far from 0, the mesh is {:.3g} large: coordinates are kept relative to "
        "the origin {}",
        step, box.largest_extent(), origin_text(*mesh.origin)));
  } else {
    mesh.origin.reset();
    parse(path, format, buffer, mesh);
    if (rough.largest_extent() == 0) return;
    mesh.notes.push_back(fmt::format(
        "its coordinates are float32, whose steps are {:.3g} so far from 0, and the mesh is {:.3g} large: "
        "what lies between was lost before",
        step, rough.largest_extent()));
  }
}

void apply_weld(const Weld& weld, MeshFile& mesh) {
  // Vertices are numbered by first appearance, so a vertex never lies behind its first corner.
  for (std::size_t vertex = 0; vertex < weld.first_point.size(); ++vertex) {
    std::copy_n(
        mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * std::size_t{weld.first_point[vertex]}), 3,
        mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * vertex));
  }
  mesh.positions.resize(3 * std::size_t{weld.vertex_count()});
  for (Face& face : mesh.faces) {
    for (std::uint32_t& index : face) index = weld.vertex_of_point[index];
  }
}

}  // namespace tvg::cli
