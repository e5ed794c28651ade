#pragma once
#include <cstdint>
#include <filesystem>
#include <httplib.h>
#include <optional>
#include <string>
#include <string_view>

// Files of a folder over HTTP, with ranges and validators as RFC 9110 has them.
namespace tvg::server {

/// The file or folder that a request's path (decoded, beginning with "/") names in `root`, which is
/// canonical. Nothing where there is none, where it leads out of the root, through a symbolic link too, or
/// where any part of it begins with a dot.
std::optional<std::filesystem::path> resolve_in_folder(const std::filesystem::path& root,
                                                       const std::string& request_path);

/// What a file's suffix says it is. Streams are model/vnd.tvg, which no authority has registered: receivers
/// should go by the signature.
std::string content_type_of(const std::filesystem::path& file);

struct ByteSpan {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};
struct RangeChoice {
  bool unsatisfiable = false;     ///< answer 416
  std::optional<ByteSpan> range;  ///< answer 206 with it; none: 200 with the whole
};
/// What a Range header asks of a file of `size` bytes. A header in another unit than bytes, one that is not
/// understood and one with several ranges is passed over, as RFC 9110 allows: the whole has them all.
RangeChoice choose_range(std::string_view header, std::uint64_t size);

/// Answers GET or HEAD for a file: 200, 206, 304, 416; 404 where it cannot be read. It is read while it is
/// sent.
void respond_with_file(const std::filesystem::path& file, const httplib::Request& request,
                       httplib::Response& response);

/// Answers GET or HEAD with a text that is made anew each time: 200, or 304 where the client has the same.
void respond_with_text(const std::string& text, const std::string& type, const httplib::Request& request,
                       httplib::Response& response);

}  // namespace tvg::server
