#include "decoder/exporters/mesh_writers.hpp"

#include "decoder/exporters/bytes.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string_view>

namespace tvg::cli {

namespace {

/// One line of numbers with a word in front.
class Line {
 public:
  explicit Line(std::string_view word) { length_ = word.copy(text_.data(), word.size()); }
  template <class T>
  void add(T number) {
    if (length_ > 0) text_[length_++] = ' ';
    const auto [end, error] = std::to_chars(text_.data() + length_, text_.data() + text_.size(), number);
    static_cast<void>(error);  // three numbers of at most 25 characters fit
    length_ = static_cast<std::size_t>(end - text_.data());
  }
  std::string_view finish() {
    text_[length_++] = '\n';
    return {text_.data(), length_};
  }

 private:
  std::array<char, 96> text_;
  std::size_t length_;
};

void write_text(AtomicFile& file, const Mesh& mesh, std::span<const float> positions, const Origin& origin,
                bool is_obj) {
  const bool placed = !is_zero(origin);
  for (std::size_t vertex = 0; vertex < mesh.vertex_count; ++vertex) {
    Line line(is_obj ? "v" : "");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float coordinate = positions[3 * vertex + axis];
      placed ? line.add(origin[axis] + double{coordinate}) : line.add(coordinate);
    }
    file.write(line.finish());
  }
  for (const Face& face : mesh.faces) {
    Line line(is_obj ? "f" : "3");
    for (const std::uint32_t index : face) line.add(std::uint64_t{index} + (is_obj ? 1 : 0));
    file.write(line.finish());
  }
}

void write_obj(AtomicFile& file, const Mesh& mesh, std::span<const float> positions, const std::string& name,
               const Origin& origin) {
  file.write(kObjMark);
  if (!name.empty()) {
    std::string one_line = name;
    std::replace_if(
        one_line.begin(), one_line.end(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); },
        ' ');
    file.write("o " + one_line + "\n");
  }
  write_text(file, mesh, positions, origin, true);
}

void write_off(AtomicFile& file, const Mesh& mesh, std::span<const float> positions, const Origin& origin) {
  file.write(fmt::format("OFF\n{} {} 0\n", mesh.vertex_count, mesh.faces.size()));
  write_text(file, mesh, positions, origin, false);
}

void write_float(AtomicFile& file, float value) {
  std::array<char, 4> bytes;
  store32(bytes.data(), value, false);
  file.write(bytes.data(), bytes.size());
}

void write_double(AtomicFile& file, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  std::array<char, 8> bytes;
  store32(bytes.data(), static_cast<std::uint32_t>(bits), false);
  store32(bytes.data() + 4, static_cast<std::uint32_t>(bits >> 32), false);
  file.write(bytes.data(), bytes.size());
}

void write_colour(AtomicFile& file, const Colour& colour) {
  const auto byte = [](float part) { return static_cast<char>(std::lround(255 * part)); };
  const std::array<char, 3> bytes = {byte(colour.red), byte(colour.green), byte(colour.blue)};
  file.write(bytes.data(), bytes.size());
}

void write_ply(AtomicFile& file, const Mesh& mesh, std::span<const float> positions,
               const VertexAttributes& attributes, const Origin& origin = {}) {
  const bool placed = !is_zero(origin);
  std::string properties;
  if (!attributes.colours.empty())
    properties += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  for (const auto& [name, values] : attributes.named) properties += "property float " + name + "\n";
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {1}\n"
      "property {0} x\nproperty {0} y\nproperty {0} z\n{2}"
      "element face {3}\nproperty list uchar {4} vertex_indices\nend_header\n",
      placed ? "double" : "float", mesh.vertex_count, properties, mesh.faces.size(),
      mesh.vertex_count > std::uint32_t{std::numeric_limits<std::int32_t>::max()} ? "uint" : "int"));
  for (std::size_t vertex = 0; vertex < mesh.vertex_count; ++vertex) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float coordinate = positions[3 * vertex + axis];
      placed ? write_double(file, origin[axis] + double{coordinate}) : write_float(file, coordinate);
    }
    if (!attributes.colours.empty()) write_colour(file, attributes.colours[vertex]);
    for (const auto& [name, values] : attributes.named) write_float(file, values[vertex]);
  }
  for (const Face& face : mesh.faces) {
    std::array<char, 13> bytes;
    bytes[0] = 3;
    for (std::size_t corner = 0; corner < 3; ++corner)
      store32(bytes.data() + 1 + 4 * corner, face[corner], false);
    file.write(bytes.data(), bytes.size());
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

void write_mesh(AtomicFile& file, MeshFormat format, const Mesh& mesh, std::span<const float> positions,
                const std::string& name, const Origin& origin) {
  switch (format) {
    case MeshFormat::kObj:
      write_obj(file, mesh, positions, name, origin);
      break;
    case MeshFormat::kPly:
      write_ply(file, mesh, positions, {}, origin);
      break;
    case MeshFormat::kOff:
      write_off(file, mesh, positions, origin);
      break;
    case MeshFormat::kStl:
      write_stl(file, mesh, positions);
      break;
  }
}

void write_coloured_ply(const std::string& path, const Mesh& mesh, std::span<const float> positions,
                        const VertexAttributes& attributes) {
  AtomicFile file(path);
  write_ply(file, mesh, positions, attributes);
  file.finish();
}

}  // namespace tvg::cli
