#pragma once
#include "decoder/exporters/mesh_frame.hpp"
#include "tool/atomic_file.hpp"
#include "tool/colour_map.hpp"
#include "tool/mesh_format.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::cli {

/// First bytes of every OBJ and MTL file that is written here.
inline constexpr const char* kObjMark = "# TVG\n";

/// Writes one frame of a mesh. In text formats each number is the shortest that reads back as the same
/// float32. PLY and STL are binary; STL holds the corners of faces only: the order of vertices, and vertices
/// without a face, are lost. The frame's origin is added, in double, in text and in PLY, which has then
/// properties of double; STL has float32 and stays relative to it. What a format has no words for is left out
/// (lost_in() says what that is).
void write_mesh(AtomicFile& file, MeshFormat format, const MeshFrame& frame);

/// The same for OBJ, with texture coordinates, normals, colours behind positions, polygons, objects, groups
/// and materials.
void write_obj(AtomicFile& file, const MeshFrame& frame);

/// The same for PLY: normals `nx ny nz`, texture coordinates `s t`, colours `red green blue alpha` (uchar
/// where they are bytes, else float) and numbers by name as properties of vertices; texture coordinates that
/// differ at the corners of a vertex as the list `texcoord` of faces; polygons as they were.
void write_ply(AtomicFile& file, const MeshFrame& frame);

/// What a PLY can say of vertices beside where they are.
struct VertexAttributes {
  std::vector<Colour> colours;                                    ///< [vertex]
  std::vector<std::pair<std::string, std::vector<float>>> named;  ///< name of the property, values [vertex]
};

/// Writes a PLY file with attributes of the vertices: colours as `red`, `green`, `blue` (uchar, sRGB), as
/// viewers know them, and each of `named` as a float. Throws ToolError (kIo).
void write_coloured_ply(const std::string& path, const Mesh& mesh, std::span<const float> positions,
                        const VertexAttributes& attributes);

}  // namespace tvg::cli
