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

/// glTF's number of a type of components.
template <class T>
constexpr int component_type() {
  if constexpr (std::is_same_v<T, float>) return 5126;
  if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
  if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
  if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
  if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
}

/// Puts a glTF 2 file together: arrays go to one embedded buffer, the rest is written into `json`.
class GltfBuilder {
 public:
  GltfBuilder() { json["asset"]["version"] = "2.0"; }

  /// Adds bytes and returns the number of their view.
  int add_view(std::string_view bytes) {
    while (buffer_.bytes().size() % 4 != 0) buffer_.add(std::uint8_t{0});
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer_.bytes().size()}, {"byteLength", bytes.size()}});
    buffer_.text(bytes);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  template <class T>
  int add_view(const std::vector<T>& values) {
    ByteString bytes(false);
    for (const T value : values) bytes.add(value);
    return add_view(bytes.bytes());
  }

  /// Adds an accessor, an object to extend, and returns its number.
  int add_accessor(nlohmann::json accessor) {
    json["accessors"].push_back(std::move(accessor));
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  /// Adds an array and returns the number of its accessor. `type` is SCALAR, VEC3, ...
  template <class T>
  int add(const std::string& type, const std::vector<T>& values) {
    const std::size_t width = type == "SCALAR" ? 1
                              : type == "VEC2" ? 2
                              : type == "VEC3" ? 3
                              : type == "VEC4" ? 4
                              : type == "MAT4" ? 16
                                               : 0;
    nlohmann::json accessor = {{"bufferView", add_view(values)},
                               {"componentType", component_type<T>()},
                               {"count", values.size() / width},
                               {"type", type}};
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
    return add_accessor(std::move(accessor));
  }

  /// The same of integers that stand for fractions.
  template <class T>
  int add_normalized(const std::string& type, const std::vector<T>& values) {
    const int accessor = add(type, values);
    json["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = true;
    return accessor;
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
    animate(clip, node, path, times, add(type, values), "LINEAR");
  }

  /// The same with the values of an accessor and an interpolation.
  void animate(std::size_t clip, int node, const std::string& path, const std::vector<float>& times,
               int values, const std::string& interpolation) {
    nlohmann::json& animation = json["animations"][clip];
    const int sampler = static_cast<int>(animation["samplers"].size());
    animation["samplers"].push_back(
        {{"input", add("SCALAR", times)}, {"output", values}, {"interpolation", interpolation}});
    animation["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  }

  /// The bytes of the buffer.
  const std::string& buffer() const { return buffer_.bytes(); }

  std::string text() {
    json["buffers"][0] = {{"byteLength", buffer().size()},
                          {"uri", "data:application/octet-stream;base64," + base64(buffer())}};
    return json.dump(1);
  }

  /// The same with the buffer in a file of that name.
  std::string text_beside(const std::string& uri) {
    json["buffers"][0] = {{"byteLength", buffer().size()}, {"uri", uri}};
    return json.dump(1);
  }

  /// The same as a binary file.
  std::string binary() {
    json["buffers"][0] = {{"byteLength", buffer().size()}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto size = [](std::size_t bytes) { return static_cast<std::uint32_t>(bytes); };
    ByteString bytes(false);
    bytes.text("glTF").add(std::uint32_t{2}).add(size(28 + text.size() + buffer().size()));
    bytes.add(size(text.size())).text("JSON").text(text);
    bytes.add(size(buffer().size())).text(std::string_view("BIN", 4)).text(buffer());
    return bytes.bytes();
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
