#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace tvg::cli {

/// The mesh files that are read and written.
enum class MeshFormat { kObj, kPly, kOff, kStl };

/// Whether `path` ends with `suffix` (".obj"), in either case.
bool has_suffix(const std::string& path, std::string_view suffix);

/// The format that the suffix of `path` names.
std::optional<MeshFormat> mesh_format(const std::string& path);

}  // namespace tvg::cli
