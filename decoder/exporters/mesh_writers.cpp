#include "decoder/exporters/mesh_writers.hpp"

#include "decoder/exporters/bytes.hpp"
#include "decoder/exporters/polygon_faces.hpp"
#include "decoder/exporters/text_line.hpp"
#include "tool/tool_error.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string_view>

namespace tvg::cli {

namespace {

/// The colours that a COFF has: [vertex][red, green, blue, alpha] as it stands in the properties.
struct OffColours {
  std::span<const float> values;
  std::size_t components = 0;  ///< 0 where there are none
  std::vector<std::uint32_t> value_index;
};

OffColours colours_of(const MeshFrame& frame) {
  const KnownAttributes known = known_attributes(frame.properties);
  if (!known.colour || values_of(frame, *known.colour).empty()) return {};
  const Attribute& attribute = frame.properties.attributes[*known.colour];
  auto value_index = vertex_values(frame.mesh, attribute);
  if (!value_index) return {};
  return {values_of(frame, *known.colour), attribute.components, std::move(*value_index)};
}

void write_off(AtomicFile& file, const MeshFrame& frame) {
  const bool placed = !is_zero(frame.origin);
  const PolygonFaces faces(frame.mesh, frame.properties);
  const OffColours colours = colours_of(frame);
  const bool bytes = are_bytes(colours.values);
  file.write(fmt::format("{}OFF\n{} {} 0\n", colours.components > 0 ? "C" : "", frame.mesh.vertex_count,
                         faces.size()));
  TextLine line;
  for (std::size_t vertex = 0; vertex < frame.mesh.vertex_count; ++vertex) {
    line.begin("");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float coordinate = frame.positions[3 * vertex + axis];
      placed ? line.add(frame.origin[axis] + double{coordinate}) : line.add(coordinate);
    }
    if (colours.components > 0) {
      const float* colour = &colours.values[colours.components * colours.value_index[vertex]];
      // Four numbers, as readers expect of a COFF; whole ones count to 255, others to 1.
      for (std::size_t i = 0; i < 4; ++i) {
        const float part = i < colours.components ? colour[i] : 1;
        if (bytes) {
          line.add(std::lround(255 * part));
        } else {
          line.add_text(fmt::format(" {:#}", part));
        }
      }
    }
    file.write(line.finish());
  }
  for (std::size_t face = 0; face < faces.size(); ++face) {
    line.begin("").add(faces[face].size());
    for (const CornerIndex corner : faces[face]) line.add(frame.mesh.faces[corner / 3][corner % 3]);
    file.write(line.finish());
  }
}

/// The unit normal of a triangle; zero where it has no area.
std::array<float, 3> normal_of(const std::array<const float*, 3>& corners) {
  std::array<double, 3> u;
  std::array<double, 3> v;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = double{corners[1][axis]} - double{corners[0][axis]};
    v[axis] = double{corners[2][axis]} - double{corners[0][axis]};
  }
  const std::array<double, 3> cross = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                       u[0] * v[1] - u[1] * v[0]};
  const double length = std::hypot(cross[0], cross[1], cross[2]);
  if (!(length > 0)) return {0, 0, 0};
  return {static_cast<float>(cross[0] / length), static_cast<float>(cross[1] / length),
          static_cast<float>(cross[2] / length)};
}

void write_stl(AtomicFile& file, const Mesh& mesh, std::span<const float> positions) {
  if (mesh.faces.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("{}: STL cannot hold {} triangles", file.path(), mesh.faces.size()));
  }
  std::array<char, 84> header{};
  std::string_view("binary STL").copy(header.data(), header.size());
  store32(header.data() + 80, static_cast<std::uint32_t>(mesh.faces.size()), false);
  file.write(header.data(), header.size());
  for (const Face& face : mesh.faces) {
    std::array<char, 50> bytes{};
    const std::array<const float*, 3> corners = {&positions[3 * std::size_t{face[0]}],
                                                 &positions[3 * std::size_t{face[1]}],
                                                 &positions[3 * std::size_t{face[2]}]};
    const std::array<float, 3> normal = normal_of(corners);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      store32(bytes.data() + 4 * axis, normal[axis], false);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        store32(bytes.data() + 12 * (corner + 1) + 4 * axis, corners[corner][axis], false);
      }
    }
    file.write(bytes.data(), bytes.size());
  }
}

}  // namespace

void write_mesh(AtomicFile& file, MeshFormat format, const MeshFrame& frame) {
  switch (format) {
    case MeshFormat::kObj:
      write_obj(file, frame);
      break;
    case MeshFormat::kPly:
      write_ply(file, frame);
      break;
    case MeshFormat::kOff:
      write_off(file, frame);
      break;
    case MeshFormat::kStl:
      write_stl(file, frame.mesh, frame.positions);
      break;
  }
}

}  // namespace tvg::cli
