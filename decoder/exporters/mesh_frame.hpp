#pragma once
#include "decoder/exporters/frame_sink.hpp"
#include "tool/origin.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// One frame of a mesh, as writers of files take it.
struct MeshFrame {
  const Mesh& mesh;
  const MeshProperties& properties;
  std::span<const float> positions;  ///< [vertex][xyz]
  AnimatedValues animated = {};
  std::string name = {};              ///< the object's, where parts name none; may be empty
  Origin origin = {};                 ///< added in double by formats that can
  std::string material_library = {};  ///< the name of the MTL file, for OBJ; may be empty
};

/// The values of an attribute (by its place in the properties) in the frame, [value][component]; empty where
/// it is animated and the frame has none.
std::span<const float> values_of(const MeshFrame& frame, std::size_t attribute);

/// The attributes that formats have words for, by their places in the properties: the first of each kind that
/// vertices or corners have.
struct KnownAttributes {
  std::optional<std::size_t> texcoord;
  std::optional<std::size_t> normal;
  std::optional<std::size_t> colour;
  std::vector<std::size_t> others;
};
KnownAttributes known_attributes(const MeshProperties& properties);

/// [vertex]: which value of the attribute it has, where all corners of each vertex have the same one; nothing
/// where they differ, or where parts have the values. A vertex without a face has value 0.
std::optional<std::vector<std::uint32_t>> vertex_values(const Mesh& mesh, const Attribute& attribute);

/// Whether all values are whole 255ths from 0 to 1: colours of bytes.
bool are_bytes(std::span<const float> values);

/// A name on a line of text: without control characters.
std::string one_line(std::string text);

}  // namespace tvg::cli
