#pragma once
#include "player/view/image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::player {

/// What of a material is drawn.
struct ShownMaterial {
  std::array<float, 4> factor{1, 1, 1, 1};  ///< linear red, green, blue and alpha
  std::shared_ptr<const Image> texture;  ///< of the base colour; null for none, and where it cannot be read
  std::size_t texcoord = 0;              ///< which of the mesh's texture coordinates it goes by
  float cutoff = 0;                      ///< what is less opaque is not there
};

/// Materials by their names, and the pictures they use.
class ShownMaterials {
 public:
  /// Whether data of this name are the materials or a picture.
  static bool wants(std::string_view name) { return name == "materials" || name.starts_with("image/"); }
  /// Takes one of the stream's data (tvg/properties.hpp) before make(); what is not wanted is left out.
  void take(NamedData data);
  /// Reads what was taken. Pictures that the data lack are read from beside the sequence, which lies in
  /// `folder`: there and below, and nowhere else; empty for none. What is broken is left out.
  void make(const std::string& folder);

  /// Null for a name that has no material.
  const ShownMaterial* find(const std::string& name) const;
  bool empty() const { return materials_.empty(); }
  /// What is to be said of pictures that are named and cannot be had; empty where there are none.
  std::string note() const;

 private:
  class Reader;

  std::map<std::string, std::vector<std::uint8_t>> pictures_;  // files, by their names in the stream
  std::vector<std::uint8_t> json_;
  std::map<std::string, ShownMaterial> materials_;
  std::vector<std::string> missing_;
};

}  // namespace tvg::player
