#pragma once
#include "encoder/importers/gltf_model.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::cli {

/// A buffer as the JSON describes it.
struct GltfBufferInfo {
  std::optional<std::string> uri;
  std::uint64_t size = 0;    ///< bytes, as promised
  bool is_fallback = false;  ///< has no bytes: all its views are compressed
};

/// A glTF file taken apart: its JSON in tinygltf's form, by number, without buffers and what belongs to
/// materials; that as JSON; where the bytes are.
struct GltfDocument {
  bool is_own = false;    ///< `tvg decode` wrote it, with extras for what glTF has no word for
  Metadata metadata;      ///< of the stream that it was decoded from
  int version = 0;        ///< the major one; of others than 2 nothing else is there
  tinygltf::Model model;  ///< an accessor without a view has the number of the last view, which is added
  std::vector<GltfBufferInfo> buffers;
  std::optional<std::string_view> binary;  ///< the chunk of a binary file; points into its bytes
  nlohmann::json
      materials;          ///< an object with what there is of `materials`, `textures`, `images`, `samplers`
  nlohmann::json extras;  ///< `extras`, an object with what there is of `scene`, `nodes` and `meshes`
  std::vector<std::string> notes;  ///< extensions that are passed over
};

/// Takes apart the bytes of a .gltf or .glb file, whichever they are; `path` is its name for messages. Throws
/// ImportError (kTruncated, kInvalidInput): sizes that promise more than there is, JSON that is not
/// well-formed or nested too deeply, extensions that the file requires and that are not read.
GltfDocument read_gltf_document(const std::string& path, std::string_view bytes);

}  // namespace tvg::cli
