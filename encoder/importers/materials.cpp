#include "encoder/importers/materials.hpp"

#include "encoder/importers/materials_builder.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/part_table.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

/// The files of a line `mtllib`: one whose name may have blanks, or several.
std::vector<std::string> libraries_of(const std::string& line, const fs::path& folder,
                                      std::vector<std::string>& missing) {
  if (const auto whole = find_beside(folder, line)) return {*whole};
  std::vector<std::string> found;
  std::istringstream words(line);
  std::vector<std::string> absent;
  for (std::string word; words >> word;) {
    if (auto path = find_beside(folder, word)) {
      found.push_back(std::move(*path));
    } else {
      absent.push_back(word);
    }
  }
  if (found.empty()) {
    missing.push_back(line);
  } else {
    missing.insert(missing.end(), absent.begin(), absent.end());
  }
  return found;
}

/// What a mesh file names.
struct NamedFiles {
  std::vector<std::string> materials;  ///< lines of names
  std::vector<std::string> textures;
};

/// What stands in the beginning of an OBJ or PLY file.
NamedFiles look_for_names(const std::string& path) {
  constexpr std::size_t kBeginning = 65536;
  constexpr std::string_view kLineEnds = "\r\n";
  constexpr std::string_view kLibrary = "mtllib ", kTexture = "comment TextureFile ";
  std::string text(kBeginning, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  NamedFiles found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(kLineEnds, begin), text.size());
    std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    line.remove_suffix(line.size() - (line.find_last_not_of(" \t") + 1));
    if (line == "end_header") break;
    if (line.starts_with(kLibrary)) found.materials.emplace_back(line.substr(kLibrary.size()));
    if (line.starts_with(kTexture)) found.textures.emplace_back(line.substr(kTexture.size()));
  }
  return found;
}

/// Adds the files of `lines` to the builder. [name]: what a material of that name is called, the first where
/// there are several.
std::map<std::string, std::string> add_libraries(MaterialsBuilder& builder, const std::string& mesh_path,
                                                 const std::vector<std::string>& lines,
                                                 std::vector<std::string>& notes) {
  const fs::path folder = fs::path(mesh_path).parent_path();
  std::vector<std::string> missing;
  std::set<std::string> read;
  std::map<std::string, std::string> names;
  for (const std::string& line : lines) {
    for (const std::string& path : libraries_of(line, folder, missing)) {
      if (!read.insert(path).second) continue;
      for (const auto& [name, called] : builder.add_library(path)) names.emplace(name, called);
    }
  }
  for (const std::string& name : missing) {
    bool latin = false;
    notes.push_back(fmt::format("{}: its material file {} is not there: of its materials only names are kept",
                                mesh_path, readable_name(name, latin)));
  }
  return names;
}

void add_mesh(MaterialsBuilder& builder, const std::string& mesh_path, const MeshFile& mesh,
              std::vector<std::string>& notes) {
  add_libraries(builder, mesh_path, mesh.material_files, notes);
  for (const std::string& file : mesh.texture_files)
    builder.add_texture(file, fs::path(mesh_path).parent_path());
  for (const Part& part : mesh.parts) {
    if (!part.material.empty()) builder.add_name(part.material);
  }
}

}  // namespace

std::vector<NamedData> read_materials(const std::string& mesh_path, const MeshFile& mesh, bool embed_textures,
                                      std::vector<std::string>& notes) {
  MaterialsBuilder builder(embed_textures, notes);
  add_mesh(builder, mesh_path, mesh, notes);
  return builder.take();
}

SequenceMaterials read_sequence_materials(const std::string& mesh_path, const MeshFile& mesh,
                                          std::span<const std::string> later, bool embed_textures,
                                          std::vector<std::string>& notes) {
  SequenceMaterials result;
  MaterialsBuilder builder(embed_textures, notes);
  add_mesh(builder, mesh_path, mesh, notes);
  std::vector<std::string> missing;
  for (const std::string& path : later) {
    const NamedFiles named = look_for_names(path);
    for (const std::string& file : named.textures) builder.add_texture(file, fs::path(path).parent_path());
    for (const auto& [name, called] : add_libraries(builder, path, named.materials, missing)) {
      if (name != called) result.renamed[path].emplace(name, called);
    }
  }
  // One for all: each file of a sequence is likely to miss its own.
  if (!missing.empty()) notes.push_back(missing[0]);
  result.data = builder.take();
  return result;
}

}  // namespace tvg::cli
