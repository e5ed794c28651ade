#include "player/playback/file_input.hpp"
#include "player/playback/http_input.hpp"
#include "player/playback/pipe_input.hpp"
#include "player/playback/stream_input.hpp"
#include "tool/remote_stream.hpp"
#include "tool/tool_error.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tvg::player {

namespace {

constexpr std::uint64_t kLittleAhead = std::uint64_t{1} << 18;

}  // namespace

std::unique_ptr<StreamInput> open_stream_input(const std::string& location, bool leaves_out) {
  if (cli::is_address(location)) {
    HttpOptions options;
    if (leaves_out) options.read_ahead = kLittleAhead;
    return std::make_unique<HttpInput>(location, options);
  }
  const bool standard_input = location == "-";
  const std::string name = standard_input ? "standard input" : location;
  const int descriptor = standard_input ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)
                                        : ::open(location.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    throw cli::ToolError(cli::ExitStatus::kIo,
                         fmt::format("{}: cannot be opened: {}", name, std::strerror(errno)));
  }
  struct stat facts {};
  if (::fstat(descriptor, &facts) != 0 || S_ISDIR(facts.st_mode)) {
    ::close(descriptor);
    throw cli::ToolError(cli::ExitStatus::kIo, fmt::format("{}: is a folder; a .tvg file is expected", name));
  }
  if (S_ISREG(facts.st_mode)) return std::make_unique<FileInput>(name, descriptor);
  return std::make_unique<PipeInput>(name, descriptor);
}

}  // namespace tvg::player
