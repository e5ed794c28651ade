#include "encoder/importers/gltf_buffers.hpp"

#include "encoder/importers/gltf_meshopt.hpp"
#include "encoder/importers/gltf_uri.hpp"
#include "encoder/importers/import_error.hpp"

#include <fmt/format.h>

namespace tvg::cli {

namespace {

std::span<const unsigned char> as_bytes(std::string_view text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

}  // namespace

void GltfBuffers::fail(const std::string& what) const {
  throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: {}", path_, what));
}

std::string GltfBuffers::load(std::size_t index) const {
  const GltfBufferInfo& info = document_.buffers[index];
  if (!info.uri) fail(fmt::format("buffer {} has no bytes: neither a \"uri\" nor a binary chunk", index));
  if (!info.uri->starts_with("data:")) return read_file_(*info.uri);
  std::optional<std::string> bytes = decode_data_uri(*info.uri);
  if (!bytes) fail(fmt::format("buffer {} is embedded, and not well-formed base64", index));
  return std::move(*bytes);
}

std::span<const unsigned char> GltfBuffers::buffer(std::size_t index) {
  if (index >= document_.buffers.size()) {
    fail(fmt::format("buffer {} is named, and there are {}", index, document_.buffers.size()));
  }
  const GltfBufferInfo& info = document_.buffers[index];
  const bool is_chunk = index == 0 && !info.uri && document_.binary;
  if (!is_chunk && !loaded_.contains(index))
    size_ += loaded_.emplace(index, load(index)).first->second.size();
  const std::span<const unsigned char> bytes = as_bytes(is_chunk ? *document_.binary : loaded_.at(index));
  if (info.size > bytes.size()) {
    throw ImportError(ErrorCode::kTruncated, fmt::format("{}: buffer {} promises {} bytes and has {}", path_,
                                                         index, info.size, bytes.size()));
  }
  return bytes.first(info.size);
}

std::span<const unsigned char> GltfBuffers::stretch(std::size_t index, std::uint64_t offset,
                                                    std::uint64_t length, int view) {
  const std::span<const unsigned char> bytes = buffer(index);
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail(fmt::format("view {} goes on to byte {} of buffer {}, which has {}", view,
                     static_cast<double>(offset) + static_cast<double>(length), index, bytes.size()));
  }
  return bytes.subspan(offset, length);
}

std::span<const unsigned char> GltfBuffers::view(int index) {
  const std::size_t count = document_.model.bufferViews.size() - 1;  // the last one is none
  if (index < 0 || static_cast<std::size_t>(index) >= count) {
    fail(fmt::format("view {} is named, and there are {}", index, count));
  }
  const tinygltf::BufferView& view = document_.model.bufferViews[static_cast<std::size_t>(index)];
  const std::optional<MeshoptView> compressed = find_meshopt(view);
  if (!compressed)
    return stretch(static_cast<std::size_t>(view.buffer), view.byteOffset, view.byteLength, index);
  const auto known = decompressed_.find(index);
  if (known != decompressed_.end()) return known->second;
  std::vector<unsigned char> decoded;
  const auto bytes = stretch(compressed->buffer, compressed->offset, compressed->length, index);
  if (const std::optional<std::string> wrong = decode_meshopt(*compressed, bytes, decoded)) {
    fail(fmt::format("view {}, compressed by meshoptimizer, {}", index, *wrong));
  }
  size_ += decoded.size();
  return decompressed_.emplace(index, std::move(decoded)).first->second;
}

}  // namespace tvg::cli
