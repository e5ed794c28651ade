#pragma once
#include <string>

namespace tvg::cli {

/// Throws ImportError (kTruncated, kInvalidInput) where the sizes in the headers of a binary glTF file
/// promise more than the file has: who trusts them allocates what they say. A file that does not begin as one
/// passes.
void check_glb_sizes(const std::string& path);

}  // namespace tvg::cli
