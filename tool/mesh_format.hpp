#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tvg::cli {

/// The mesh files that are read and written.
enum class MeshFormat { kObj, kPly, kOff, kStl };

/// Whether `path` ends with `suffix` (".obj"), in either case.
bool has_suffix(const std::string& path, std::string_view suffix);

/// Whether `path` names a vertex cache: .pc2, .pc16, .mdd, .npy or .npz, in either case.
bool is_cache_file(const std::string& path);

/// The caches that lie beside a mesh file under its name ("hand.pc2" beside "hand.obj").
std::vector<std::string> caches_beside(const std::string& mesh);

/// The format that the suffix of `path` names.
std::optional<MeshFormat> mesh_format(const std::string& path);

}  // namespace tvg::cli
