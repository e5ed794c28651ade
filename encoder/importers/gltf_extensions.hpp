#pragma once
#include <array>
#include <string>
#include <vector>

namespace tvg::cli {

/// The names under which views are compressed by meshoptimizer.
inline constexpr std::array<const char*, 2> kMeshoptExtensions = {"EXT_meshopt_compression",
                                                                  "KHR_meshopt_compression"};

/// Throws ImportError (kInvalidInput) that names an extension which the file requires and which is not read.
/// Those that change nothing but how a surface looks are as good as read.
void check_required_extensions(const std::string& path, const std::vector<std::string>& required);

/// Notes of extensions that a file uses, can be read without, and would place vertices.
std::vector<std::string> extension_notes(const std::string& path, const std::vector<std::string>& used);

}  // namespace tvg::cli
