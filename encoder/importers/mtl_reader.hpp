#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tvg::cli {

/// A texture that a material of an MTL file names.
struct MtlTexture {
  std::string file;  ///< as the file has it; empty for none
  bool clamped = false;
};

/// A material of an MTL file.
struct MtlMaterial {
  std::string name;
  std::vector<std::string>
      lines;  ///< all of them but `newmtl`, without blanks around them, comments and empty ones
  std::optional<std::array<float, 3>> diffuse;                    ///< Kd
  std::optional<std::array<float, 3>> emissive;                   ///< Ke
  std::optional<float> opacity;                                   ///< d, or 1 - Tr
  std::optional<float> shininess;                                 ///< Ns
  std::optional<float> roughness;                                 ///< Pr
  std::optional<float> metallic;                                  ///< Pm
  MtlTexture diffuse_map, emissive_map, opacity_map, normal_map;  ///< map_Kd, map_Ke, map_d, norm
};

/// Reads the materials of an MTL file. What is no number is taken as not said; a line before the first
/// material is passed over. Names and lines become text in UTF-8. Throws ImportError where the bytes are no
/// text.
std::vector<MtlMaterial> parse_mtl(const std::string& file, std::string_view bytes);

}  // namespace tvg::cli
