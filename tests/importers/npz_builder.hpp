#pragma once
#include "tests/importers/io_toolbox.hpp"

#include <cstdint>
#include <string>
#include <vector>

// Arrays as NumPy writes them, alone and in archives.
namespace tvg::cli::testing {

inline std::string npy(const std::string& type, const std::string& shape, const std::string& values) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }\n";
  ByteString bytes(false);
  bytes.text(std::string_view("\x93NUMPY\x01\x00", 8))
      .add(static_cast<std::uint16_t>(header.size()))
      .text(header);
  return bytes.bytes() + values;
}

struct NpzEntry {
  std::string name;
  std::string bytes;
  bool deflated = false;
  bool wide = false;  ///< sizes of 64 bits
};

/// One block of deflate that is stored as it is.
inline std::string deflated(const std::string& bytes) {
  ByteString block(false);
  block.add(std::uint8_t{1})
      .add(static_cast<std::uint16_t>(bytes.size()))
      .add(static_cast<std::uint16_t>(~bytes.size()));
  return block.bytes() + bytes;
}

/// As ZIP has it, bit by bit.
inline std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = UINT32_MAX;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

inline std::string npz(const std::vector<NpzEntry>& entries) {
  ByteString file(false), directory(false);
  for (const NpzEntry& entry : entries) {
    const std::string stored = entry.deflated ? deflated(entry.bytes) : entry.bytes;
    const auto begin = static_cast<std::uint32_t>(file.bytes().size());
    const auto method = static_cast<std::uint16_t>(entry.deflated ? 8 : 0);
    const auto stored_size = static_cast<std::uint32_t>(stored.size());
    const auto size = static_cast<std::uint32_t>(entry.bytes.size());
    const auto name_size = static_cast<std::uint16_t>(entry.name.size());
    file.add(std::uint32_t{0x04034b50})
        .add(std::uint16_t{20})
        .add(std::uint16_t{0})
        .add(method)
        .add(std::uint32_t{0});
    file.add(std::uint32_t{0})
        .add(stored_size)
        .add(size)
        .add(name_size)
        .add(std::uint16_t{3})
        .text(entry.name)
        .text("abc");
    file.text(stored);
    directory.add(std::uint32_t{0x02014b50})
        .add(std::uint16_t{20})
        .add(std::uint16_t{20})
        .add(std::uint16_t{0})
        .add(method);
    directory.add(std::uint32_t{0}).add(crc_of(entry.bytes));
    directory.add(entry.wide ? UINT32_MAX : stored_size).add(entry.wide ? UINT32_MAX : size).add(name_size);
    directory.add(static_cast<std::uint16_t>(entry.wide ? 20 : 0))
        .add(std::uint16_t{0})
        .add(std::uint16_t{0});
    directory.add(std::uint16_t{0}).add(std::uint32_t{0}).add(begin).text(entry.name);
    if (entry.wide)
      directory.add(std::uint16_t{1})
          .add(std::uint16_t{16})
          .add(std::uint64_t{size})
          .add(std::uint64_t{stored_size});
  }
  const auto count = static_cast<std::uint16_t>(entries.size());
  ByteString end(false);
  end.add(std::uint32_t{0x06054b50}).add(std::uint32_t{0}).add(count).add(count);
  end.add(static_cast<std::uint32_t>(directory.bytes().size()))
      .add(static_cast<std::uint32_t>(file.bytes().size()));
  end.add(std::uint16_t{0});
  return file.bytes() + directory.bytes() + end.bytes();
}

}  // namespace tvg::cli::testing
