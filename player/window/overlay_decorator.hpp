#pragma once
#include "player/overlay/overlay_colours.hpp"
#include "player/playback/player_frame.hpp"

#include <memory>
#include <mutex>
#include <string>

namespace tvg::player {

/// Colours frames by an overlay in the decoding thread. Its scale only grows, so that colours do not flicker.
class OverlayDecorator final : public FrameDecorator {
 public:
  /// As make_overlay_colours() does; the overlay is not kNone. `stream`: its name, for messages.
  OverlayDecorator(const OverlaySpec& spec, std::string stream);

  void on_gop(const Mesh& mesh, const PlayerGop& gop) override;
  void on_frame(PlayerFrame& frame) override;

  // Both may be called while frames are being decorated.
  Legend legend() const;
  /// Why the last frame could not be coloured; empty where it could.
  std::string problem() const;

 private:
  const Overlay overlay_;
  const std::shared_ptr<const JointTracks> joints_;
  const std::string stream_;
  const std::unique_ptr<OverlayColours> colours_;
  mutable std::mutex mutex_;
  std::string problem_;
};

}  // namespace tvg::player
