#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace tvg::cli {

/// The mesh files that are read and written.
enum class MeshFormat { kObj, kPly, kOff, kStl };

/// Whether `path` ends with `suffix` (".obj"), in either case.
bool has_suffix(const std::string& path, std::string_view suffix);

/// Whether `path` names a vertex cache: .pc2 or .mdd, in either case.
bool is_cache_file(const std::string& path);

/// The format that the suffix of `path` names.
std::optional<MeshFormat> mesh_format(const std::string& path);

}  // namespace tvg::cli
