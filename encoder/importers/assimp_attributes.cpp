#include "encoder/importers/assimp_attributes.hpp"

#include "encoder/importers/scene_attributes.hpp"

#include <algorithm>
#include <assimp/mesh.h>
#include <cmath>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

/// `values`: of vertices, each with `components` numbers one after the other.
template <class Value>
void add(const aiMesh& mesh, std::string name, AttributeKind kind, std::uint32_t components,
         const Value* values, ScenePart& part) {
  Attribute attribute = empty_attribute(std::move(name), kind, components);
  attribute.values.reserve(std::size_t{components} * mesh.mNumVertices);
  for (unsigned vertex = 0; vertex < mesh.mNumVertices; ++vertex) {
    for (std::uint32_t component = 0; component < components; ++component)
      attribute.values.push_back(values[vertex][component]);
  }
  if (!std::all_of(attribute.values.begin(), attribute.values.end(),
                   [](float value) { return std::isfinite(value); })) {
    part.notes.push_back(fmt::format("mesh \"{}\", {} has numbers that are not finite: it is left out",
                                     mesh.mName.C_Str(), attribute.name));
    return;
  }
  part.attributes.push_back(std::move(attribute));
}

}  // namespace

void read_assimp_attributes(const aiMesh& mesh, ScenePart& part) {
  for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set) {
    if (mesh.mTextureCoords[set] == nullptr) continue;
    const std::uint32_t components = std::clamp(mesh.mNumUVComponents[set], 1u, 3u);
    add(mesh, fmt::format("TEXCOORD_{}", set), AttributeKind::kTexcoord, components, mesh.mTextureCoords[set],
        part);
  }
  if (mesh.mNormals != nullptr) add(mesh, "NORMAL", AttributeKind::kNormal, 3, mesh.mNormals, part);
  for (unsigned set = 0; set < AI_MAX_NUMBER_OF_COLOR_SETS; ++set) {
    if (mesh.mColors[set] == nullptr) continue;
    add(mesh, fmt::format("COLOR_{}", set), AttributeKind::kColour, 4, mesh.mColors[set], part);
  }
}

}  // namespace tvg::cli
