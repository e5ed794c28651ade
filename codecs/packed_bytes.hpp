#pragma once
#include <span>
#include <vector>

namespace tvg::bench {

using Bytes = std::vector<unsigned char>;

/// Throws std::runtime_error that names `what` unless it succeeded.
void require(bool success, const char* what);

/// One frame of zstd at level 19.
Bytes zstd_compress(std::span<const unsigned char> bytes);

/// Fills `bytes`, which has the size of what was compressed. Throws std::runtime_error where it does not fit.
void zstd_decompress(const Bytes& packed, Bytes& bytes);

}  // namespace tvg::bench
