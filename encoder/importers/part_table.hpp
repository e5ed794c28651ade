#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

struct MeshFile;

/// Which faces of a mesh file belong together, while they are read: a part is made by the first face that has
/// its object, group, material and smoothing group together.
class PartTable {
 public:
  void set_object(std::string_view name) { set(next_.part.object, name); }
  void set_group(std::string_view name) { set(next_.part.group, name); }
  void set_material(std::string_view name) { set(next_.part.material, name); }
  /// 0 for none.
  void set_smoothing(float number) {
    next_.smoothing = number;
    changed_ = true;
  }
  /// Before the first triangle of a face, which is the `triangles`th.
  void begin_face(std::size_t triangles) {
    if (changed_) begin_run(triangles);
  }
  /// Whether a name was no UTF-8 and was read as Latin-1.
  bool had_latin_names() const { return latin_; }

  /// Gives the mesh, all of whose faces were read, its parts, and the smoothing groups as an attribute of
  /// them. A mesh whose only part has no names gets none.
  void give_to(MeshFile& mesh);

 private:
  struct Key {
    Part part;
    float smoothing = 0;
    bool operator<(const Key& other) const;
  };
  void set(std::string& name, std::string_view text);
  void begin_run(std::size_t triangles);

  Key next_;
  bool changed_ = true;
  bool latin_ = false;
  std::map<Key, std::uint32_t> numbers_;
  std::vector<Key> parts_;
  std::vector<std::pair<std::size_t, std::uint32_t>> runs_;  // first triangle and part
};

/// The name of the attribute of parts that smoothing groups become (OBJ's `s`; 0 is `s off`).
inline constexpr const char* kSmoothingGroup = "smoothing_group";

/// A name as text in UTF-8 without control characters: as it is, or read as Latin-1. `latin` becomes true
/// then.
std::string readable_name(std::string_view text, bool& latin);

}  // namespace tvg::cli
