#pragma once
#include "tests/importers/gltf_builder.hpp"
#include "tests/importers/npz_builder.hpp"

#include <string>

// Files of formats, or with what they can hold, that are read and not written.
namespace tvg::cli::testing {

/// A textured triangle, whose texture is its material.
inline std::string textured_ply() {
  return "ply\nformat ascii 1.0\ncomment TextureFile wood.png\nelement vertex 3\nproperty float x\n"
         "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
         "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 1 0\n";
}

inline std::string off_with_all() {
  return "STNOFF\n3 1 0\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0 1 0 0 1 0 0 1\n3 0 1 2\n";
}

/// PC2 with three frames of the tetrahedron as float16.
inline std::string pc16_bytes() {
  ByteString bytes(false);
  bytes.text(std::string_view("POINTCACHE2", 12)).add(std::int32_t{1}).add(std::int32_t{4});
  bytes.add(0.0F).add(1.0F).add(std::int32_t{3});
  for (std::uint16_t frame = 0; frame < 3; ++frame) {
    // 1.0 is 0x3c00, 0.5 is 0x3800; the first frame's vertices, and then the last one rises.
    for (const int number : {0, 0, 0, 0x3c00, 0, 0, 0, 0x3c00, 0x3000, 0, 0xb800, 0x3c00 + frame})
      bytes.add(static_cast<std::uint16_t>(number));
  }
  return bytes.bytes();
}

inline std::string npz_of_frames() {
  ByteString values(false);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    for (const float value : tetrahedron_positions(frame)) values.add(value);
  }
  return npz({{"positions.npy", npy("<f4", "3, 4, 3", values.bytes())}});
}

/// A triangle that one joint carries.
inline std::string skinned_gltf() {
  GltfBuilder builder;
  nlohmann::json primitive = builder.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
  primitive["attributes"]["JOINTS_0"] = builder.add("VEC4", std::vector<std::uint8_t>(12, 0));
  primitive["attributes"]["WEIGHTS_0"] =
      builder.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  builder.json["meshes"][0]["primitives"] = {primitive};
  builder.json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0, "skin": 0}, {"name": "hip"}])");
  builder.json["skins"] = nlohmann::json::parse(R"([{"joints": [1]}])");
  builder.json["scenes"] = nlohmann::json::parse(R"([{"nodes": [0, 1]}])");
  builder.json["scene"] = 0;
  builder.animate(0, 1, "translation", {0, 1}, "VEC3", {0, 0, 0, 0, 1, 0});
  return builder.text();
}

/// A list of numbers of COLLADA, and its accessor.
inline std::string dae_source(const std::string& id, const std::string& numbers, int count,
                              const std::string& params) {
  const std::size_t stride = params.size();
  std::string text = "<source id='" + id + "'><float_array id='" + id + "a' count='" +
                     std::to_string(stride * static_cast<std::size_t>(count)) + "'>" + numbers +
                     "</float_array><technique_common><accessor source='#" + id + "a' count='" +
                     std::to_string(count) + "' stride='" + std::to_string(stride) + "'>";
  for (const char param : params) text += std::string("<param name='") + param + "' type='float'/>";
  return text + "</accessor></technique_common></source>";
}

/// A square with texture coordinates, normals, colours and a red material, that rises by 1 in a second.
inline std::string whole_dae() {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><up_axis>Y_UP</up_axis></asset>"
         "<library_effects><effect id='e'><profile_COMMON><technique sid='t'><lambert><diffuse><color>1 0 0 "
         "1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>"
         "<library_materials><material id='m' name='red'><instance_effect url='#e'/></material>"
         "</library_materials><library_geometries><geometry id='g' name='g'><mesh>" +
         dae_source("p", "0 0 0 1 0 0 1 1 0 0 1 0", 4, "XYZ") + dae_source("n", "0 0 1 0 1 0", 2, "XYZ") +
         dae_source("u", "0 0 1 0 1 1 0 1", 4, "ST") +
         dae_source("c", "1 0 0 1 0 1 0 1 0 0 1 1 1 1 1 1", 4, "RGBA") +
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
         "<polylist count='1' material='s'><input semantic='VERTEX' source='#v' offset='0'/>"
         "<input semantic='NORMAL' source='#n' offset='1'/>"
         "<input semantic='TEXCOORD' source='#u' offset='2' set='0'/>"
         "<input semantic='COLOR' source='#c' offset='3'/><vcount>4</vcount>"
         "<p>0 0 0 0 1 0 1 1 2 1 2 2 3 0 3 3</p></polylist></mesh></geometry></library_geometries>"
         "<library_animations><animation id='a'>" +
         dae_source("ai", "0 1", 2, "T") + dae_source("ao", "0 0 0 0 1 0", 2, "XYZ") +
         "<sampler id='as'><input semantic='INPUT' source='#ai'/><input semantic='OUTPUT' source='#ao'/>"
         "</sampler><channel source='#as' target='node/move'/></animation></library_animations>"
         "<library_visual_scenes><visual_scene id='vs'><node id='node' name='node'>"
         "<translate sid='move'>0 0 0</translate><instance_geometry url='#g'><bind_material>"
         "<technique_common><instance_material symbol='s' target='#m'/></technique_common></bind_material>"
         "</instance_geometry></node></visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url='#vs'/></scene></COLLADA>";
}

/// A triangle that one joint carries.
inline std::string skinned_dae() {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><up_axis>Y_UP</up_axis></asset>"
         "<library_geometries><geometry id='g' name='g'><mesh>" +
         dae_source("p", "0 0 0 1 0 0 0 1 0", 3, "XYZ") +
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
         "<triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles>"
         "</mesh></geometry></library_geometries><library_controllers><controller id='c'><skin source='#g'>"
         "<source id='j'><Name_array id='ja' count='1'>hip</Name_array><technique_common>"
         "<accessor source='#ja' count='1' stride='1'><param name='JOINT' type='name'/></accessor>"
         "</technique_common></source>"
         "<source id='b'><float_array id='ba' count='16'>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</float_array>"
         "<technique_common><accessor source='#ba' count='1' stride='16'>"
         "<param name='TRANSFORM' type='float4x4'/></accessor></technique_common></source>" +
         dae_source("w", "1", 1, "W") +
         "<joints><input semantic='JOINT' source='#j'/><input semantic='INV_BIND_MATRIX' source='#b'/>"
         "</joints><vertex_weights count='3'><input semantic='JOINT' source='#j' offset='0'/>"
         "<input semantic='WEIGHT' source='#w' offset='1'/><vcount>1 1 1</vcount><v>0 0 0 0 0 0</v>"
         "</vertex_weights></skin></controller></library_controllers>"
         "<library_visual_scenes><visual_scene id='vs'><node id='hip' sid='hip' name='hip' type='JOINT'>"
         "<translate sid='move'>0 0 0</translate></node><node id='n' name='n'>"
         "<instance_controller url='#c'><skeleton>#hip</skeleton></instance_controller></node>"
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#vs'/></scene></COLLADA>";
}

}  // namespace tvg::cli::testing
