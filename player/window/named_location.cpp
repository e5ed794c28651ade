#include "player/window/named_location.hpp"

#include "tool/percent_decoded.hpp"

#include <string_view>

namespace tvg::player {

std::string named_location(const std::string& text) {
  constexpr std::string_view kSpace = " \t\r\n";
  constexpr std::string_view kFile = "file://";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string::npos) return {};
  std::string line = text.substr(begin, text.find_first_of("\r\n", begin) - begin);
  line.erase(line.find_last_not_of(kSpace) + 1);
  if (!line.starts_with(kFile)) return line;
  const std::size_t path = line.find('/', kFile.size());  // behind the host, which is this one
  return path == std::string::npos ? line : cli::percent_decoded(std::string_view(line).substr(path));
}

}  // namespace tvg::player
