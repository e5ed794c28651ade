#include "server/request_head.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

namespace tvg::server {

namespace {

constexpr std::string_view kLineEnd = "\r\n";

/// The next line without its end, which is taken off `text` with it.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find(kLineEnd), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + kLineEnd.size(), text.size()));
  return line;
}

bool is_token(std::string_view text) {
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("!#$%&'*+-.^_`|~").find(static_cast<char>(c)) != std::string_view::npos;
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), allowed);
}

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

bool is_length(std::string_view text) {
  constexpr std::size_t kMostDigits = 18;  // any of them fits 64 bits
  return !text.empty() && text.size() <= kMostDigits &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// A line break that is no CR LF, or a zero byte: where a line ends must be the same for every reader.
bool has_stray_bytes(std::string_view head) {
  for (std::size_t i = 0; i < head.size(); ++i) {
    const char before = i > 0 ? head[i - 1] : '\0';
    const char after = i + 1 < head.size() ? head[i + 1] : '\0';
    if (head[i] == '\0' || (head[i] == '\n' && before != '\r') || (head[i] == '\r' && after != '\n'))
      return true;
  }
  return false;
}

/// What the headers say about the host and about where the body ends.
struct Framing {
  int hosts = 0;
  std::optional<std::string_view> length;
  std::optional<std::string_view> coding;
  bool bad = false;

  void take(std::string_view name, std::string_view value) {
    if (same_name(name, "Host")) ++hosts;
    if (same_name(name, "Content-Length")) {
      bad = bad || !is_length(value) || (length && *length != value);
      length = value;
    }
    if (same_name(name, "Transfer-Encoding")) {
      bad = bad || coding.has_value();
      coding = value;
    }
  }
};

}  // namespace

std::size_t end_of_head(std::string_view text) {
  // A head whose lines end in LF alone is refused, but not waited for.
  const std::size_t proper = text.find("\n\r\n");
  const std::size_t bare = text.find("\n\n");
  if (proper < bare) return proper + 3;
  return bare == std::string_view::npos ? bare : bare + 2;
}

int refusal_of_head(std::string_view head) {
  if (has_stray_bytes(head)) return 400;
  const std::string_view request = next_line(head);
  const bool sends = request.starts_with("PUT ") || request.starts_with("POST ");
  const bool old = request.ends_with(" HTTP/1.0");
  Framing framing;
  for (std::string_view line = next_line(head); !line.empty(); line = next_line(head)) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon))) return 400;
    framing.take(line.substr(0, colon), trimmed(line.substr(colon + 1)));
  }
  if (framing.bad || framing.hosts > 1 || (framing.hosts == 0 && !old)) return 400;
  if (framing.coding && !same_name(*framing.coding, "chunked")) return 501;
  if (framing.coding && (framing.length || old)) return 400;
  if (sends && !framing.coding && !framing.length) return 411;
  return 0;
}

std::string head_for_routes(std::string_view head) {
  constexpr std::string_view kRange = "Range:";
  std::string renamed;
  while (!head.empty()) {
    const std::string_view line = next_line(head);
    if (same_name(line.substr(0, kRange.size()), kRange)) {
      renamed.append(kRangeHeader).append(":").append(line.substr(kRange.size()));
    } else {
      renamed.append(line);
    }
    renamed.append(kLineEnd);
  }
  return renamed;
}

}  // namespace tvg::server
