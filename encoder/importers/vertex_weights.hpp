#pragma once
#include <string>
#include <vector>

namespace tvg::cli {

/// Reads one number per vertex: a text with a number on each line (blank lines and lines that begin with #
/// do not count), or, where the name ends with .npy, a NumPy array of one dimension of little-endian float32
/// or float64. All numbers are finite. Throws ImportError: kIo, kInvalidInput, kTruncated.
std::vector<double> read_vertex_weights(const std::string& path);

/// The same of the bytes of such a file; `path` is its name.
std::vector<double> parse_vertex_weights(const std::string& path, const std::string& bytes);

}  // namespace tvg::cli
