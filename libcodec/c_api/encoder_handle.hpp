#pragma once
#include "c_api/support.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <tvg/encoder.hpp>

/// What a handle stands for.
struct tvg_encoder {
  tvg::EncodeOptions options;
  tvg::ByteSink sink;
  std::optional<tvg::Encoder> encoder;  ///< once there is a mesh
  std::uint32_t vertex_count = 0;
  tvg::MeshProperties properties;  ///< of the mesh to come
  /// Of the mesh: [attribute], how many components it has where it is animated, else 0.
  std::vector<std::uint32_t> animated_components;
  std::vector<std::vector<float>> values;  ///< [attribute], of the frame to come
  std::vector<float> positions;            ///< [vertex][xyz]
  std::string error_text;
};

namespace tvg::c_api {

/// Remembers what went wrong and gives its code back.
inline tvg_code fail(tvg_encoder& encoder, tvg_code code, const char* text) {
  try {
    encoder.error_text = text;
  } catch (const std::exception&) {
    encoder.error_text.clear();
  }
  return code;
}

/// Runs what may throw for want of memory.
template <class Work>
tvg_code guarded(tvg_encoder& encoder, Work work) {
  try {
    const Status status = work();
    return status.ok() ? TVG_OK : fail(encoder, code_of(status.error()), status.error().describe().c_str());
  } catch (const std::exception&) {
    return fail(encoder, TVG_ERROR_OUT_OF_MEMORY, "out of memory");
  }
}

inline Mesh mesh_of(std::uint32_t vertex_count, const std::uint32_t* faces, std::uint32_t face_count) {
  Mesh mesh;
  mesh.vertex_count = vertex_count;
  mesh.faces.resize(face_count);
  if (face_count > 0) std::memcpy(mesh.faces.data(), faces, face_count * sizeof(Face));
  return mesh;
}

/// As much of the text as there is room for, and a zero.
inline void write_text(const std::string& text, char* target, std::size_t size) {
  if (target == nullptr || size == 0) return;
  const std::size_t count = std::min(text.size(), size - 1);
  std::memcpy(target, text.data(), count);
  target[count] = '\0';
}

}  // namespace tvg::c_api
