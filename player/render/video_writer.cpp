#include "player/render/video_writer.hpp"

#include "tool/mesh_format.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace tvg::player {

namespace {

/// What ffmpeg gets for one kind of file.
struct VideoFormat {
  std::string_view suffix;
  std::vector<std::string> arguments;
};

const std::array<VideoFormat, 3>& video_formats() {
  static const std::array<VideoFormat, 3> formats = {
      {{".mp4",
        {"-c:v", "libx264", "-crf", "18", "-preset", "medium", "-movflags", "+faststart", "-f", "mp4"}},
       {".mkv", {"-c:v", "libx264", "-crf", "18", "-preset", "medium", "-f", "matroska"}},
       {".webm", {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1", "-f", "webm"}}}};
  return formats;
}

std::vector<std::string> ffmpeg_arguments(const std::string& name, const std::string& target, int width,
                                          int height, const std::string& fps) {
  std::vector<std::string> arguments = {"ffmpeg",     "-nostdin",    "-hide_banner",
                                        "-loglevel",  "error",       "-y",
                                        "-f",         "rawvideo",    "-pixel_format",
                                        "rgba",       "-video_size", fmt::format("{}x{}", width, height),
                                        "-framerate", fps,           "-i",
                                        "pipe:0",     "-pix_fmt",    "yuv420p"};
  for (const VideoFormat& format : video_formats()) {
    if (!cli::has_suffix(name, format.suffix)) continue;
    arguments.insert(arguments.end(), format.arguments.begin(), format.arguments.end());
  }
  arguments.push_back("file:" + target);
  return arguments;
}

/// Starts a program of the PATH with `input` as its standard input and `messages` as its other two. 0, or an
/// error number.
int spawn(pid_t& process, const std::vector<std::string>& arguments, int input, int messages) {
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, messages, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, messages, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);  // this tool ignores it, and that would be inherited
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int error = posix_spawnp(&process, pointers[0], &files, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

}  // namespace

bool is_video_name(const std::string& path) {
  const auto& formats = video_formats();
  return std::any_of(formats.begin(), formats.end(),
                     [&path](const VideoFormat& format) { return cli::has_suffix(path, format.suffix); });
}

VideoWriter::VideoWriter(const std::string& path, int width, int height, const std::string& fps)
    : file_(path) {
  if (!file_.seekable()) {
    throw cli::ToolError(cli::ExitStatus::kUsage, path + ": a clip must be a file, no pipe or device");
  }
  std::array<int, 2> ends{};
  messages_ = memfd_create("ffmpeg", MFD_CLOEXEC);
  if (messages_ < 0 || pipe2(ends.data(), O_CLOEXEC) != 0) {
    const int reason = errno;
    if (messages_ >= 0) close(messages_);
    throw cli::ToolError(cli::ExitStatus::kIo, fmt::format("cannot start ffmpeg: {}", std::strerror(reason)));
  }
  const int error =
      spawn(process_, ffmpeg_arguments(path, file_.temporary_path(), width, height, fps), ends[0], messages_);
  close(ends[0]);
  if (error == 0) {
    pipe_ = ends[1];
    return;
  }
  close(ends[1]);
  close(messages_);
  throw cli::ToolError(
      cli::ExitStatus::kOther,
      fmt::format("{}: clips are made by ffmpeg, which cannot be started ({}): install it (on "
                  "Debian: apt-get install ffmpeg), or write pictures with -o out%04d.png",
                  path, std::strerror(error)));
}

VideoWriter::~VideoWriter() {
  close_pipe();
  if (process_ > 0) {
    kill(process_, SIGTERM);
    wait();
  }
  if (messages_ >= 0) close(messages_);
}

void VideoWriter::close_pipe() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
}

int VideoWriter::wait() {
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

void VideoWriter::add(const Image& image) {
  const std::uint8_t* bytes = image.pixels.data();
  std::size_t left = image.pixels.size();
  while (left > 0) {
    const ssize_t count = ::write(pipe_, bytes, left);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail();
    bytes += count;
    left -= static_cast<std::size_t>(count);
  }
}

void VideoWriter::fail() {
  close_pipe();
  if (process_ > 0) wait();
  std::array<char, 400> text{};
  const ssize_t count = pread(messages_, text.data(), text.size() - 1, 0);
  std::string words(text.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  while (!words.empty() && words.back() == '\n') words.pop_back();
  std::replace(words.begin(), words.end(), '\n', ' ');
  throw cli::ToolError(cli::ExitStatus::kOther,
                       fmt::format("{}: ffmpeg failed{}{}; with -o out%04d.png pictures are "
                                   "written without it",
                                   file_.path(), words.empty() ? "" : ": ", words));
}

void VideoWriter::finish() {
  close_pipe();
  const int status = wait();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail();
  file_.finish();
}

}  // namespace tvg::player
