#pragma once
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

}  // namespace tvg::cli
