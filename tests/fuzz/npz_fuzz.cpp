#include "encoder/importers/array_file.hpp"
#include "encoder/importers/import_error.hpp"
#include "fuzz/memory_file.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// The input: the archive. Each of its arrays is read, and its beginning again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using tvg::fuzz::MemoryFile;
  const MemoryFile file({data, size}, MemoryFile::Kind::kRegular);
  std::vector<tvg::cli::NpzEntry> entries;
  try {
    entries = tvg::cli::list_npz(file.path());
  } catch (const tvg::cli::ImportError&) {
    return 0;
  }
  constexpr std::size_t kPiece = 1000, kMostPieces = 64;
  for (const tvg::cli::NpzEntry& entry : entries) {
    try {
      const auto array = tvg::cli::open_npz_entry(file.path(), entry);
      std::vector<std::uint8_t> piece(kPiece), again(kPiece);
      const std::size_t first = array->read(piece.data(), kPiece);
      for (std::size_t i = 0; i < kMostPieces && array->read(again.data(), kPiece) == kPiece;) ++i;
      array->seek(0);
      tvg::fuzz::require(array->read(again.data(), kPiece) == first);
      again.resize(first);
      piece.resize(first);
      tvg::fuzz::require(again == piece);
    } catch (const tvg::cli::ImportError&) {
      // An answer as good as any.
    }
  }
  return 0;
}
