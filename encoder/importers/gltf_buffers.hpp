#pragma once
#include "encoder/importers/gltf_document.hpp"

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tvg::cli {

/// Gives the bytes of a file that a URI names. Throws ImportError.
using GltfFileReader = std::function<std::string(const std::string& uri)>;

/// The bytes of buffers and views, brought in where they are asked for: a buffer of pictures that is missing
/// does not matter.
class GltfBuffers {
 public:
  /// `document` and what its binary chunk points to outlive it. `path` is for messages.
  GltfBuffers(const std::string& path, const GltfDocument& document, GltfFileReader read_file)
      : path_(path), document_(document), read_file_(std::move(read_file)) {}

  /// The bytes of a view, decompressed. Throws ImportError (kIo, kInvalidInput, kTruncated).
  std::span<const unsigned char> view(int index);
  /// The bytes of a file that a URI names.
  std::string file(const std::string& uri) const { return read_file_(uri); }
  /// Bytes that have been brought in and decompressed so far.
  std::uint64_t size() const { return size_; }

 private:
  std::span<const unsigned char> buffer(std::size_t index);
  std::span<const unsigned char> stretch(std::size_t buffer, std::uint64_t offset, std::uint64_t length,
                                         int view);
  std::string load(std::size_t index) const;
  [[noreturn]] void fail(const std::string& what) const;

  const std::string& path_;
  const GltfDocument& document_;
  GltfFileReader read_file_;
  std::map<std::size_t, std::string> loaded_;               // by buffer
  std::map<int, std::vector<unsigned char>> decompressed_;  // by view
  std::uint64_t size_ = 0;
};

}  // namespace tvg::cli
