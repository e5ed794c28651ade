#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

struct MeshFile;

/// What the material files of a mesh file say, as data that go with a stream: "materials" and, with
/// `embed_textures`, "image/NAME" for each texture that can be read. Every material that a part has is
/// described, if only by its name; empty where there are none. `mesh_path` is where the mesh was read from,
/// which files are named relative to. What cannot be read or is said twice is a note.
std::vector<NamedData> read_materials(const std::string& mesh_path, const MeshFile& mesh, bool embed_textures,
                                      std::vector<std::string>& notes);

/// The materials of a sequence of mesh files.
struct SequenceMaterials {
  std::vector<NamedData> data;  ///< as read_materials() gives them
  /// [mesh file][name in it]: what a material is called whose name another one has, of another material file.
  std::map<std::string, std::map<std::string, std::string>> renamed;
};

/// The same of a sequence whose first mesh is `mesh`, read from `mesh_path`, and whose `later` files may name
/// other material files and textures. Of those only the beginning is read, where such names stand.
SequenceMaterials read_sequence_materials(const std::string& mesh_path, const MeshFile& mesh,
                                          std::span<const std::string> later, bool embed_textures,
                                          std::vector<std::string>& notes);

}  // namespace tvg::cli
