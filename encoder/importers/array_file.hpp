#pragma once
#include "encoder/importers/input_file.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tvg::cli {

/// The bytes of a NumPy array, read front to back or from any place. Failures are ImportError.
class ArrayFile {
 public:
  virtual ~ArrayFile() = default;
  /// As messages call it: "hand.npy", "hand.npz, array 'vertices'".
  virtual const std::string& name() const = 0;
  virtual std::uint64_t size() const = 0;
  /// Reads up to `size` bytes; fewer only at the end.
  virtual std::size_t read(void* data, std::size_t size) = 0;
  virtual void seek(std::uint64_t offset) = 0;
};

/// A .npy file. Throws ImportError where it is no regular file.
std::unique_ptr<ArrayFile> open_array_file(const std::string& path);

/// An array of a .npz file, which is a ZIP archive of .npy files.
struct NpzEntry {
  std::string name;  ///< without .npy
  bool deflated = false;
  std::uint64_t stored_size = 0;  ///< bytes in the archive
  std::uint64_t size = 0;         ///< bytes of the array
  std::uint64_t header = 0;       ///< where its local header is
  std::uint32_t crc = 0;          ///< CRC-32 of the array's bytes
};

/// The arrays of a .npz file. Throws ImportError where it is no archive, or one of another kind (encrypted,
/// another compression).
std::vector<NpzEntry> list_npz(const std::string& path);

/// One of them. Going back in a deflated one reads it from its beginning. Its checksum is compared where the
/// array is read from front to back; an ImportError tells that it differs.
std::unique_ptr<ArrayFile> open_npz_entry(const std::string& path, const NpzEntry& entry);

}  // namespace tvg::cli
