#pragma once
#include "player/overlay/overlay_colours.hpp"
#include "player/playback/player_frame.hpp"

#include <memory>
#include <mutex>
#include <string>

namespace tvg::cli {

/// Colours frames by an overlay in the decoding thread. Its scale only grows, so that colours do not flicker.
class OverlayDecorator final : public FrameDecorator {
 public:
  /// As make_overlay_colours() does; the overlay is not kNone.
  explicit OverlayDecorator(const OverlaySpec& spec);

  void on_gop(const Mesh& mesh, const PlayerGop& gop) override;
  void on_frame(PlayerFrame& frame) override;

  /// May be called while frames are being decorated. Where the last one could not be coloured, it says why.
  Legend legend() const;

 private:
  const Overlay overlay_;
  const std::unique_ptr<OverlayColours> colours_;
  mutable std::mutex mutex_;
  std::string problem_;
};

}  // namespace tvg::cli
