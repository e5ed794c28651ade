#pragma once
#include "tests/importers/io_toolbox.hpp"

#include <nlohmann/json.hpp>

namespace tvg::cli::testing {

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t block = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      block = block << 8 | (i + j < bytes.size() ? static_cast<std::uint8_t>(bytes[i + j]) : 0u);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j <= bytes.size() ? kDigits[block >> (18 - 6 * j) & 63] : '=';
    }
  }
  return text;
}

/// Puts a glTF 2 file together: arrays go to one embedded buffer, the rest is written into `json`.
class GltfBuilder {
 public:
  GltfBuilder() { json["asset"]["version"] = "2.0"; }

  /// Adds an array and returns the number of its accessor. `type` is SCALAR, VEC3, ...
  template <class T>
  int add(const std::string& type, const std::vector<T>& values) {
    constexpr std::size_t kFloat = 5126, kUint16 = 5123, kUint8 = 5121;
    while (buffer_.bytes().size() % 4 != 0) buffer_.add(std::uint8_t{0});
    const std::size_t offset = buffer_.bytes().size();
    for (const T value : values) buffer_.add(value);
    const std::size_t width = type == "SCALAR" ? 1
                              : type == "VEC3" ? 3
                              : type == "VEC4" ? 4
                              : type == "MAT4" ? 16
                                               : 0;
    const int view = static_cast<int>(json["bufferViews"].size());
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
    const std::size_t component = std::is_same_v<T, float> ? kFloat : sizeof(T) == 2 ? kUint16 : kUint8;
    nlohmann::json accessor = {
        {"bufferView", view}, {"componentType", component}, {"count", values.size() / width}, {"type", type}};
    if constexpr (std::is_same_v<T, float>) {
      accessor["min"] = nlohmann::json::array();
      accessor["max"] = nlohmann::json::array();
      for (std::size_t i = 0; i < width; ++i) {
        float low = values[i], high = values[i];
        for (std::size_t j = i; j < values.size(); j += width) {
          low = std::min(low, values[j]);
          high = std::max(high, values[j]);
        }
        accessor["min"].push_back(low);
        accessor["max"].push_back(high);
      }
    }
    json["accessors"].push_back(std::move(accessor));
    return view;
  }

  /// Adds a primitive of triangles to a mesh, as an object to extend.
  nlohmann::json primitive(const std::vector<float>& positions, const std::vector<std::uint16_t>& corners) {
    nlohmann::json primitive;
    primitive["attributes"]["POSITION"] = add("VEC3", positions);
    primitive["indices"] = add("SCALAR", corners);
    return primitive;
  }

  /// Adds a linear channel to a clip: `path` is translation, rotation, scale or weights.
  void animate(std::size_t clip, int node, const std::string& path, const std::vector<float>& times,
               const std::string& type, const std::vector<float>& values) {
    nlohmann::json& animation = json["animations"][clip];
    const int sampler = static_cast<int>(animation["samplers"].size());
    animation["samplers"].push_back({{"input", add("SCALAR", times)}, {"output", add(type, values)}});
    animation["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  }

  std::string text() {
    json["buffers"] = {{{"byteLength", buffer_.bytes().size()},
                        {"uri", "data:application/octet-stream;base64," + base64(buffer_.bytes())}}};
    return json.dump(1);
  }

  nlohmann::json json;

 private:
  ByteString buffer_{false};
};

/// Makes one scene of the nodes that have no parent.
inline void set_roots(GltfBuilder& gltf, const std::vector<int>& roots) {
  gltf.json["scenes"] = {{{"nodes", roots}}};
  gltf.json["scene"] = 0;
}

}  // namespace tvg::cli::testing
