#pragma once
#include "encoder/importers/gltf_model.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tvg::cli {

/// What EXT_meshopt_compression says of a view.
struct MeshoptView {
  std::size_t buffer = 0;
  std::uint64_t offset = 0;  ///< of the compressed bytes
  std::uint64_t length = 0;
  std::uint64_t stride = 0;  ///< bytes of an element
  std::uint64_t count = 0;   ///< elements
  std::string mode;
  std::string filter;
};

/// The extension of a view; nothing where it has none.
std::optional<MeshoptView> find_meshopt(const tinygltf::BufferView& view);

/// Decodes a view into stride x count bytes. Those are bounded by the bytes that come in before anything is
/// allocated. What is wrong in a sentence's end ("has a filter ..."), or nothing.
std::optional<std::string> decode_meshopt(const MeshoptView& view, std::span<const unsigned char> bytes,
                                          std::vector<unsigned char>& decoded);

}  // namespace tvg::cli
