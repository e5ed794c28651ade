#include "tool/remote_stream.hpp"

#include "tool/tool_error.hpp"

namespace tvg::cli {

namespace {

RemoteOpener the_opener = nullptr;

}  // namespace

bool is_address(const std::string& name) {
  return name.starts_with("http://") || name.starts_with("https://");
}

void use_remote_opener(RemoteOpener opener) {
  the_opener = opener;
}

std::unique_ptr<RemoteStream> open_remote_stream(const std::string& url) {
  if (the_opener == nullptr) {
    throw ToolError(ExitStatus::kUsage, "cannot read " + url + ": this tvg was built without HTTP; curl " +
                                            url + " | tvg ... - does the same");
  }
  return the_opener(url);
}

}  // namespace tvg::cli
