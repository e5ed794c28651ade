#pragma once
#include "decoder/exporters/frame_sink.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli::testing {

/// Two squares side by side, each of a part of its own, with a seam of texture coordinates between them.
struct WholeMesh {
  Mesh mesh = {6, {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}};
  MeshProperties properties;
  FramePositions positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0};

  WholeMesh() {
    properties.parts = {{"left", "front", "red"}, {"right", "", "blue"}};
    properties.face_parts = {0, 0, 1, 1};
    properties.polygons = {{0, 4}, {2, 4}};
    Attribute texcoord;
    texcoord.kind = AttributeKind::kTexcoord;
    texcoord.domain = AttributeDomain::kCorner;
    texcoord.components = 2;
    texcoord.values = {0, 0, 0.5F, 0, 0.5F, 1, 0, 1, 0.75F, 0, 1, 0, 1, 1, 0.75F, 1};
    texcoord.corners = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    properties.attributes.push_back(texcoord);
  }

  Attribute& add(AttributeKind kind, std::uint32_t components, std::vector<float> values,
                 std::string name = "") {
    Attribute& attribute = properties.attributes.emplace_back();
    attribute.name = std::move(name);
    attribute.kind = kind;
    attribute.components = components;
    attribute.values = std::move(values);
    return attribute;
  }
  void add_normals() {
    add(AttributeKind::kNormal, 3, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0});
  }
  void add_colours() {
    add(AttributeKind::kColour, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0.2F, 0});
  }

  /// Frame i: everything moved by i along x, and vertex 5 by i along z.
  FramePositions frame(int i) const {
    FramePositions moved = positions;
    for (std::size_t vertex = 0; vertex < mesh.vertex_count; ++vertex)
      moved[3 * vertex] += static_cast<float>(i);
    moved[17] += static_cast<float>(i);
    return moved;
  }

  void write(FrameSink& sink, int frames,
             const Metadata& metadata = {{"fps", "25"}, {"name", "squares"}}) const {
    sink.begin_mesh(mesh, properties, metadata, static_cast<std::uint64_t>(frames));
    for (int i = 0; i < frames; ++i) sink.write_frame(frame(i));
    sink.finish();
  }
};

inline NamedData named_data(std::string name, std::string_view bytes) {
  return {std::move(name), {bytes.begin(), bytes.end()}};
}

/// The smallest PNG there is to speak of: what tells it from others is all that is looked at.
inline constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n and so on";

/// A red and a blue material, the red one with a texture that came with the stream.
inline NamedData two_materials() {
  return named_data("materials", R"({"materials": [
      {"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5], "roughnessFactor": 0.5,
       "metallicFactor": 0, "baseColorTexture": {"index": 0}}, "emissiveFactor": [0, 0, 0.25]},
      {"name": "blue", "extras": {"mtl": "Kd 0 0 1\nKa 0.1 0.1 0.1\nmap_Kd wood.png\n"}}],
    "textures": [{"source": 0}], "images": [{"uri": "wood.png", "extras": {"data": "image/wood.png"}}]})");
}

}  // namespace tvg::cli::testing
