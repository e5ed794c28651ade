#pragma once
#include <cstddef>
#include <string>
#include <string_view>

// A request's head as RFC 9112 has it, looked at before httplib takes it apart: httplib lets pass what two
// readers could understand differently.
namespace tvg::server {

/// The most bytes of a head.
inline constexpr std::size_t kMostHeadBytes = std::size_t{1} << 15;

/// Under this name a request's Range reaches the routes: httplib would answer units that it does not know
/// with 416, and apply the others to texts of errors too.
inline constexpr const char* kRangeHeader = "X-Tvg-Range";

/// Offset behind the empty line that ends a head; npos where `text` has none.
std::size_t end_of_head(std::string_view text);

/// The status to refuse this head with, or 0. 400: lines that end in less than CR LF, names of headers that
/// are none (blanks before the colon), no host or two, a length that is no number, two that differ, a length
/// beside a transfer coding. 411: a PUT or POST that does not say where its body ends. 501: a transfer coding
/// other than chunked.
int refusal_of_head(std::string_view head);

/// The head with Range renamed to kRangeHeader.
std::string head_for_routes(std::string_view head);

}  // namespace tvg::server
