#include "encoder/importers/glb_header.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"

#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <string_view>

namespace tvg::cli {

namespace {

constexpr std::uint64_t kHeaderSize = 12;
constexpr std::uint64_t kChunkHeaderSize = 8;
constexpr int kChunks = 2;  // what follows JSON and buffer is for others

}  // namespace

void check_glb_sizes(const std::string& path) {
  InputFile file(path);
  if (!file.size()) return;
  std::array<char, kHeaderSize> header{};
  const std::size_t got = file.read(header.data(), header.size());
  if (got < header.size() || !std::string_view(header.data(), got).starts_with("glTF")) return;
  const std::uint64_t size = load<std::uint32_t>(header.data() + 8, false);
  if (size > *file.size()) {
    throw ImportError(ErrorCode::kTruncated, fmt::format("{} ends at byte {}; its header promises {} bytes",
                                                         path, *file.size(), size));
  }
  std::uint64_t begin = kHeaderSize;
  for (int chunk = 0; chunk < kChunks && begin + kChunkHeaderSize <= size; ++chunk) {
    std::array<char, kChunkHeaderSize> prefix{};
    file.seek(begin);
    if (file.read(prefix.data(), prefix.size()) < prefix.size()) return;
    const std::uint64_t length = load<std::uint32_t>(prefix.data(), false);
    const std::uint64_t left = size - begin - kChunkHeaderSize;
    if (length > left) {
      throw ImportError(ErrorCode::kInvalidInput,
                        fmt::format("{}, byte {}: a chunk of {} bytes is promised where {} are left", path,
                                    begin, length, left));
    }
    begin += kChunkHeaderSize + length;
  }
}

}  // namespace tvg::cli
