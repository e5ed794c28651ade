#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tvg::cli {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of a scalar in a binary file.
std::size_t ply_type_size(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;  ///< of the scalar, or of each item of the list
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< of a list's length; an integer type
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t line = 0;  ///< of the header

  /// The property's index; the number of properties where there is none of that name.
  std::size_t find(std::string_view property) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;   ///< in the order of their data
  std::vector<std::string> textures;  ///< of comments "TextureFile NAME", in their order
  std::size_t size = 0;               ///< bytes up to the data
  std::size_t lines = 0;              ///< lines up to the data
};

/// Reads a PLY header; errors are ImportError with the line.
PlyHeader parse_ply_header(const std::string& file, std::string_view bytes);

}  // namespace tvg::cli
