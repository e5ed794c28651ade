#include "decoder/exporters/bytes.hpp"
#include "decoder/exporters/mesh_writers.hpp"
#include "decoder/exporters/polygon_faces.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace tvg::cli {

namespace {

/// Properties of a vertex that come from one attribute.
struct VertexColumns {
  std::span<const float> values;
  std::size_t stride = 1;                  ///< components of the attribute
  std::size_t count = 1;                   ///< of them that are written
  std::vector<std::uint32_t> value_index;  ///< [vertex]
  bool bytes = false;
};

class PlyWriter {
 public:
  PlyWriter(AtomicFile& file, const MeshFrame& frame)
      : file_(file), frame_(frame), faces_(frame.mesh, frame.properties) {
    const KnownAttributes known = known_attributes(frame.properties);
    if (known.normal) add_columns(*known.normal, {"nx", "ny", "nz"});
    if (known.texcoord && !add_columns(*known.texcoord, {"s", "t"}) &&
        !values_of(frame, *known.texcoord).empty()) {
      corner_texcoords_ = *known.texcoord;
    }
    if (known.colour) add_columns(*known.colour, {"red", "green", "blue", "alpha"});
    for (const std::size_t other : known.others)
      add_columns(other, names_of(frame.properties.attributes[other]));
  }

  void write() {
    write_header();
    for (std::size_t vertex = 0; vertex < frame_.mesh.vertex_count; ++vertex) write_vertex(vertex);
    for (std::size_t face = 0; face < faces_.size(); ++face) write_face(faces_[face]);
  }

 private:
  /// A name that no property has yet: letters, digits and what else is no space.
  std::string free_name(const std::string& wanted) {
    std::string name = wanted.empty() ? "value" : wanted;
    std::replace_if(
        name.begin(), name.end(),
        [](char c) {
          return std::isspace(static_cast<unsigned char>(c)) || std::iscntrl(static_cast<unsigned char>(c));
        },
        '_');
    const std::string stem = name;
    for (int number = 2; !taken_.insert(name).second; ++number) name = fmt::format("{}_{}", stem, number);
    return name;
  }

  static std::vector<std::string> names_of(const Attribute& attribute) {
    static constexpr std::array<const char*, 4> kKinds = {"texcoord", "normal", "colour", "value"};
    const std::string stem =
        attribute.name.empty() ? kKinds[static_cast<std::size_t>(attribute.kind)] : attribute.name;
    if (attribute.components == 1) return {stem};
    std::vector<std::string> names;
    names.reserve(attribute.components);
    for (std::size_t i = 0; i < attribute.components; ++i) names.push_back(fmt::format("{}_{}", stem, i));
    return names;
  }

  bool add_columns(std::size_t index, const std::vector<std::string>& names) {
    const Attribute& attribute = frame_.properties.attributes[index];
    const std::span<const float> values = values_of(frame_, index);
    if (values.empty()) return false;
    auto value_index = vertex_values(frame_.mesh, attribute);
    if (!value_index) return false;
    VertexColumns& columns = columns_.emplace_back();
    columns.values = values;
    columns.stride = attribute.components;
    columns.count = std::min<std::size_t>(names.size(), attribute.components);
    columns.value_index = std::move(*value_index);
    columns.bytes = attribute.kind == AttributeKind::kColour && are_bytes(values);
    for (std::size_t i = 0; i < columns.count; ++i) {
      declared_ += fmt::format("property {} {}\n", columns.bytes ? "uchar" : "float", free_name(names[i]));
    }
    return true;
  }

  void write_header() {
    const bool placed = !is_zero(frame_.origin);
    const std::uint32_t most_for_int = std::numeric_limits<std::int32_t>::max();
    wide_counts_ = faces_.most_corners() > (corner_texcoords_ ? 127U : 255U);
    const char* count = wide_counts_ ? "uint" : "uchar";
    file_.write(fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {1}\n"
        "property {0} x\nproperty {0} y\nproperty {0} z\n{2}"
        "element face {3}\nproperty list {4} {5} vertex_indices\n{6}end_header\n",
        placed ? "double" : "float", frame_.mesh.vertex_count, declared_, faces_.size(), count,
        frame_.mesh.vertex_count > most_for_int ? "uint" : "int",
        corner_texcoords_ ? fmt::format("property list {} float texcoord\n", count) : std::string()));
  }

  void write_double(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    write32(static_cast<std::uint32_t>(bits));
    write32(static_cast<std::uint32_t>(bits >> 32));
  }

  template <class T>
  void write32(T value) {
    std::array<char, 4> bytes;
    store32(bytes.data(), value, false);
    file_.write(bytes.data(), bytes.size());
  }

  void write_vertex(std::size_t vertex) {
    const bool placed = !is_zero(frame_.origin);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float coordinate = frame_.positions[3 * vertex + axis];
      placed ? write_double(frame_.origin[axis] + double{coordinate}) : write32(coordinate);
    }
    for (const VertexColumns& columns : columns_) {
      const float* value = &columns.values[columns.stride * columns.value_index[vertex]];
      for (std::size_t i = 0; i < columns.count; ++i) {
        if (columns.bytes) {
          const auto byte = static_cast<char>(std::lround(255 * value[i]));
          file_.write(&byte, 1);
        } else {
          write32(value[i]);
        }
      }
    }
  }

  void write_count(std::size_t count) {
    if (wide_counts_) return write32(static_cast<std::uint32_t>(count));
    const auto byte = static_cast<char>(count);
    file_.write(&byte, 1);
  }

  void write_face(std::span<const CornerIndex> corners) {
    write_count(corners.size());
    for (const CornerIndex corner : corners) write32(frame_.mesh.faces[corner / 3][corner % 3]);
    if (!corner_texcoords_) return;
    const Attribute& attribute = frame_.properties.attributes[*corner_texcoords_];
    const std::span<const float> values = values_of(frame_, *corner_texcoords_);
    write_count(2 * corners.size());
    for (const CornerIndex corner : corners) {
      const std::size_t value = attribute.components * std::size_t{attribute.corners[corner]};
      write32(values[value]);
      write32(values[value + 1]);
    }
  }

  AtomicFile& file_;
  const MeshFrame& frame_;
  PolygonFaces faces_;
  std::set<std::string> taken_ = {"x", "y", "z"};
  std::string declared_;  ///< the header's lines for columns_
  std::vector<VertexColumns> columns_;
  std::optional<std::size_t> corner_texcoords_;
  bool wide_counts_ = false;
};

}  // namespace

void write_ply(AtomicFile& file, const MeshFrame& frame) {
  PlyWriter(file, frame).write();
}

void write_coloured_ply(const std::string& path, const Mesh& mesh, std::span<const float> positions,
                        const VertexAttributes& attributes) {
  MeshProperties properties;
  if (!attributes.colours.empty()) {
    Attribute& colour = properties.attributes.emplace_back();
    colour.kind = AttributeKind::kColour;
    colour.components = 3;
    for (const Colour& shade : attributes.colours) {
      for (const float part : {shade.red, shade.green, shade.blue})
        colour.values.push_back(std::round(255 * part) / 255);
    }
  }
  for (const auto& [name, values] : attributes.named) {
    Attribute& attribute = properties.attributes.emplace_back();
    attribute.name = name;
    attribute.values = values;
  }
  AtomicFile file(path);
  write_ply(file, {mesh, properties, positions});
  file.finish();
}

}  // namespace tvg::cli
