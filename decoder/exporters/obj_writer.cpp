#include "decoder/exporters/mesh_writers.hpp"
#include "decoder/exporters/polygon_faces.hpp"
#include "decoder/exporters/text_line.hpp"

#include <optional>

namespace tvg::cli {

namespace {

class ObjWriter {
 public:
  ObjWriter(AtomicFile& file, const MeshFrame& frame)
      : file_(file), frame_(frame), known_(known_attributes(frame.properties)) {}

  void write() {
    file_.write(kObjMark);
    if (!frame_.material_library.empty()) write_name("mtllib", frame_.material_library);
    if (!frame_.name.empty() && !parts_name_objects()) write_name("o", frame_.name);
    write_positions();
    texcoords_ = write_values("vt", known_.texcoord);
    normals_ = write_values("vn", known_.normal);
    write_faces();
  }

 private:
  bool parts_name_objects() const {
    for (const Part& part : frame_.properties.parts) {
      if (!part.object.empty()) return true;
    }
    return false;
  }

  void write_name(const char* word, const std::string& name) {
    line_.begin(word);
    if (!name.empty()) line_.add_text(" ").add_text(one_line(name));
    file_.write(line_.finish());
  }

  void write_positions() {
    const bool placed = !is_zero(frame_.origin);
    std::optional<std::vector<std::uint32_t>> of_vertex;
    std::span<const float> colours;
    std::size_t components = 0;
    if (known_.colour) {
      const Attribute& attribute = frame_.properties.attributes[*known_.colour];
      colours = values_of(frame_, *known_.colour);
      components = attribute.components;
      if (!colours.empty()) of_vertex = vertex_values(frame_.mesh, attribute);
    }
    for (std::size_t vertex = 0; vertex < frame_.mesh.vertex_count; ++vertex) {
      line_.begin("v");
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float coordinate = frame_.positions[3 * vertex + axis];
        placed ? line_.add(frame_.origin[axis] + double{coordinate}) : line_.add(coordinate);
      }
      if (of_vertex) {
        for (std::size_t i = 0; i < 3; ++i) line_.add(colours[components * (*of_vertex)[vertex] + i]);
      }
      file_.write(line_.finish());
    }
  }

  /// Writes the values of an attribute; where it can be written, gives it back.
  const Attribute* write_values(const char* word, const std::optional<std::size_t>& index) {
    if (!index) return nullptr;
    const Attribute& attribute = frame_.properties.attributes[*index];
    const std::span<const float> values = values_of(frame_, *index);
    if (values.empty()) return nullptr;
    const std::size_t written = attribute.components > 3 ? 3 : attribute.components;
    for (std::size_t i = 0; i + attribute.components <= values.size(); i += attribute.components) {
      line_.begin(word);
      for (std::size_t component = 0; component < written; ++component) line_.add(values[i + component]);
      file_.write(line_.finish());
    }
    return &attribute;
  }

  /// The names of a part, where they are others than those in force.
  void begin_part(const Part& part) {
    const auto tell = [this](const char* word, const std::string& name, std::string& in_force) {
      if (name == in_force) return;
      write_name(word, name);
      in_force = name;
    };
    tell("o", part.object, in_force_.object);
    tell("g", part.group, in_force_.group);
    tell("usemtl", part.material, in_force_.material);
  }

  void write_faces() {
    const PolygonFaces faces(frame_.mesh, frame_.properties);
    const std::vector<std::uint32_t>& face_parts = frame_.properties.face_parts;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const auto corners = faces[i];
      if (const std::size_t face = corners[0] / 3; face < face_parts.size())
        begin_part(frame_.properties.parts[face_parts[face]]);
      line_.begin("f");
      for (const CornerIndex corner : corners) add_corner(corner);
      file_.write(line_.finish());
    }
  }

  static std::uint64_t value_at(const Attribute& attribute, CornerIndex corner, std::uint32_t vertex) {
    return 1 +
           std::uint64_t{attribute.domain == AttributeDomain::kCorner ? attribute.corners[corner] : vertex};
  }

  void add_corner(CornerIndex corner) {
    const std::uint32_t vertex = frame_.mesh.faces[corner / 3][corner % 3];
    line_.add(std::uint64_t{vertex} + 1);
    if (texcoords_ == nullptr && normals_ == nullptr) return;
    line_.add_text("/");
    if (texcoords_ != nullptr) line_.add_to_last(value_at(*texcoords_, corner, vertex));
    if (normals_ != nullptr) line_.add_text("/").add_to_last(value_at(*normals_, corner, vertex));
  }

  AtomicFile& file_;
  const MeshFrame& frame_;
  KnownAttributes known_;
  TextLine line_;
  Part in_force_;
  const Attribute* texcoords_ = nullptr;
  const Attribute* normals_ = nullptr;
};

}  // namespace

void write_obj(AtomicFile& file, const MeshFrame& frame) {
  ObjWriter(file, frame).write();
}

}  // namespace tvg::cli
