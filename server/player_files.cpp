#include "server/player_files.hpp"

#include "server/file_response.hpp"
#include "tool/player_page.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <string_view>

namespace tvg::server {

namespace {

/// Nothing comes from elsewhere, and nothing is sent elsewhere, whatever a name or a stream says. The worker
/// is made of a part of the script.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; connect-src 'self'; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; base-uri 'none'; form-action 'none'";

}  // namespace

bool wants_html(const httplib::Request& request) {
  return request.get_header_value("Accept").find("text/html") != std::string::npos;
}

PlayerFiles::PlayerFiles(const std::string& folder) : folder_(folder) {
  if (folder.empty()) return;
  const std::filesystem::path path = folder_ / "index.html";
  std::ifstream file(path, std::ios::binary);
  std::string html{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) throw cli::ToolError(cli::ExitStatus::kIo, fmt::format("{}: cannot be read", path.string()));
  cli::PlayerPage page(std::move(html), path.string());
  page.set({});
  page.set_base(kFolder);
  page_ = page.html();
}

bool PlayerFiles::answer(const httplib::Request& request, httplib::Response& response) const {
  const std::string_view path = request.path;
  if (!available()) return false;
  if (path == "/" && (request.has_param("stream") || request.has_param("live"))) {
    response.set_header("Content-Security-Policy", kPolicy);
    respond_with_text(page_, "text/html; charset=utf-8", request, response);
    return true;
  }
  if (!path.starts_with(kFolder)) return false;
  const std::string_view name = path.substr(std::string_view(kFolder).size());
  // The page itself is answered above, completed.
  if (name == "index.html" || std::ranges::find(cli::kPlayerFiles, name) == cli::kPlayerFiles.end())
    return false;
  response.set_header("Cache-Control", "no-cache");  // asked for again, and sent where it is another
  respond_with_file(folder_ / name, request, response);
  return true;
}

}  // namespace tvg::server
