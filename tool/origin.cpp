#include "tool/origin.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace tvg::cli {

std::string origin_text(const Origin& origin) {
  return fmt::format("{} {} {}", origin[0], origin[1], origin[2]);
}

std::optional<Origin> origin_of(const Metadata& metadata) {
  Origin origin{};
  const auto entry = metadata.find(kOriginKey);
  if (entry == metadata.end()) return origin;
  std::string_view text = entry->second;
  for (double& coordinate : origin) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), coordinate);
    if (error != std::errc{} || !std::isfinite(coordinate)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  if (!text.empty()) return std::nullopt;
  return origin;
}

std::string relative_note(const Origin& origin, const std::string& format) {
  return fmt::format("{} has float32, so its positions are relative to the origin {}: add it in double",
                     format, origin_text(origin));
}

bool is_zero(const Origin& origin) {
  return origin == Origin{};
}

}  // namespace tvg::cli
