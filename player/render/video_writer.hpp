#pragma once
#include "player/view/image.hpp"
#include "tool/atomic_file.hpp"

#include <string>
#include <sys/types.h>

namespace tvg::player {

/// Whether a file of this name is a clip: .mp4, .webm or .mkv.
bool is_video_name(const std::string& path);

/// Writes pictures to a clip by ffmpeg, which must be in the PATH. The file appears under its name when
/// finish() returns; ffmpeg is ended and what it wrote removed where that is not reached.
class VideoWriter {
 public:
  /// All pictures have this size, in even numbers. `fps`: as parse_frame_rate() takes it. Throws ToolError:
  /// kOther where there is no ffmpeg, kIo.
  VideoWriter(const std::string& path, int width, int height, const std::string& fps);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  void add(const Image& image);
  /// Throws ToolError (kOther) with ffmpeg's own words where it fails.
  void finish();

 private:
  [[noreturn]] void fail();
  int wait();
  void close_pipe();

  cli::AtomicFile file_;
  int pipe_ = -1;
  int messages_ = -1;  // a file without a name that holds what ffmpeg says
  pid_t process_ = -1;
};

}  // namespace tvg::player
