// The implementation of tinygltf's header, without files and images: it is given JSON and nothing else.
#include <fstream>
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include "encoder/importers/gltf_model.hpp"

namespace tvg::cli {

bool load_gltf_model(const std::string& json, tinygltf::Model& model, std::string& reason) {
  tinygltf::TinyGLTF loader;
  std::string warnings;
  return loader.LoadASCIIFromString(&model, &reason, &warnings, json.data(),
                                    static_cast<unsigned>(json.size()), "", tinygltf::NO_REQUIRE);
}

}  // namespace tvg::cli
