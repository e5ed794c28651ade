#pragma once
#include <string>
#include <string_view>

namespace tvg::cli {

/// `text` with its %XX replaced by the bytes they stand for; others stay as they are.
std::string percent_decoded(std::string_view text);

}  // namespace tvg::cli
