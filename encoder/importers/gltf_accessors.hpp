#pragma once
#include "encoder/importers/gltf_buffers.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tvg::cli {

/// Numbers that all accessors of a file may have together: some, and so many for each byte that there is.
/// More are refused: an accessor without a view has as many zeros as it says, and many may share one view.
/// Nodes may make a sixteenth as many vertices of them.
struct GltfLimits {
  std::uint64_t numbers = std::uint64_t{1} << 28;
  std::uint64_t numbers_per_byte = 64;

  /// Of a file of so many bytes.
  std::uint64_t most_numbers(std::uint64_t bytes) const;
  std::uint64_t most_vertices(std::uint64_t bytes) const;
};

/// Reads accessors: strided, sparse or without bytes, integers as they are or normalized.
class GltfAccessors {
 public:
  GltfAccessors(const std::string& path, const GltfDocument& document, GltfFileReader read_file,
                const GltfLimits& limits);

  /// Elements of an accessor, which must be there.
  std::uint64_t count(int index, const std::string& what) const;
  /// Components of its elements; 0 of types that are not read.
  std::size_t width(int index, const std::string& what) const;
  bool has_bytes(int index, const std::string& what) const;
  /// [element][component], of elements with `width` components. `what` is read, for messages. `normalized`
  /// takes integers for fractions whatever the accessor says. Throws ImportError: bytes that are not there,
  /// types that do not fit, more than the limits.
  std::vector<double> read(int index, std::size_t width, const std::string& what, bool normalized = false);
  /// The bytes of a view, decompressed, as GltfBuffers has them.
  std::span<const unsigned char> view(int index) { return buffers_.view(index); }
  /// The bytes of a file that a URI names. Throws ImportError.
  std::string file(const std::string& uri) const { return buffers_.file(uri); }
  /// Bytes of buffers and views that have been used, and of the binary chunk.
  std::uint64_t bytes() const { return bytes_ + buffers_.size(); }
  /// Unsigned integers, [element][component].
  std::vector<std::uint32_t> read_numbers(int index, std::size_t width, const std::string& what);

 private:
  const tinygltf::Accessor& find(int index, const std::string& what) const;
  std::vector<double> read_plain(const tinygltf::Accessor& accessor, std::size_t width,
                                 const std::string& what);
  void read_elements(const tinygltf::Accessor& accessor, std::size_t width, const std::string& what,
                     std::vector<double>& values);
  void read_sparse(const tinygltf::Accessor& accessor, std::size_t width, const std::string& what,
                   std::vector<double>& values);
  void take_budget(std::uint64_t count, std::size_t width, const std::string& what);
  [[noreturn]] void fail(const std::string& what, const std::string& why) const;

  const std::string& path_;
  const GltfDocument& document_;
  GltfBuffers buffers_;
  GltfLimits limits_;
  std::uint64_t bytes_ = 0;  // of the binary chunk
  std::uint64_t taken_ = 0;
};

}  // namespace tvg::cli
