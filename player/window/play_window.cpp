#include "player/window/play_window.hpp"

#include "player/window/play_session.hpp"

#include <utility>

namespace tvg::player {

void run_play_window(const PlayOptions& options) {
  const Stopwatch watch;
  // First, so that a mistyped name opens no window, and a connection is on its way while one opens.
  std::unique_ptr<StreamInput> input =
      options.location.empty() ? nullptr : open_stream_input(options.location, options.lod > 0);
  PlaySession(options, watch, std::move(input)).run();
}

}  // namespace tvg::player
