#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace tvg::cli {

/// The bytes of a data URI; nothing where they are not well-formed. `uri` begins with "data:".
std::optional<std::string> decode_data_uri(std::string_view uri);

/// Reads the file that a URI names beside `scene`, within its folder or those below: whatever a file from a
/// stranger names may end up in what is made of it, so nothing else on the machine is opened, and nothing is
/// fetched from elsewhere. Throws ImportError that names both (kIo, kInvalidInput).
std::string read_beside(const std::string& scene, const std::string& uri);

}  // namespace tvg::cli
