#include "player/render/poster.hpp"

#include "player/frames/shown_frames.hpp"
#include "player/render/picture.hpp"
#include "player/view/look.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>

namespace tvg::player {

namespace {

/// Of what has no colour of its own, as the page has it.
constexpr cli::Colour kPageSurface{0.72F, 0.72F, 0.75F};
/// The room that the page gives to what moves, in radii of the first frame.
constexpr double kRoom = 0.24;

/// The picture without its background, of what it looks like before black and before white.
Image without_background(const Image& black, const Image& white) {
  Image image = black;
  for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4) {
    int seen_through = 255;  // of the white behind it, by the colour that shows the least of it
    for (std::size_t k = 0; k < 3; ++k)
      seen_through = std::min(seen_through, std::max(0, white.pixels[i + k] - black.pixels[i + k]));
    const int alpha = 255 - seen_through;
    for (std::size_t k = 0; k < 3; ++k) {
      const int colour = alpha == 0 ? 0 : (255 * black.pixels[i + k] + alpha / 2) / alpha;
      image.pixels[i + k] = static_cast<std::uint8_t>(std::min(255, colour));
    }
    image.pixels[i + 3] = static_cast<std::uint8_t>(alpha);
  }
  return image;
}

}  // namespace

Image draw_poster(const std::string& stream, int width, int height) {
  ShownFramesSpec spec;
  spec.inputs = {stream};
  spec.surfaces = true;
  const std::unique_ptr<ShownFrames> frames = open_stream_frames(spec);
  ShownFrame frame;
  do {
    if (!frames->next(frame))
      throw cli::ToolError(cli::ExitStatus::kInvalidInput, stream + ": there is no frame to draw");
  } while (shows_nothing(*frame.mesh));

  Style style;
  style.surface = kPageSurface;
  style.shading = shading_of(frames->metadata());
  PicturePainter painter(width, height, style, false);
  BoundingBox bounds;
  bounds.extend(frame.positions);
  bounds.pad(kRoom * view_radius(bounds));
  OrbitCamera camera;
  camera.set_orientation(Orientation(up_of(frames->metadata())));
  ViewExtent extent = camera.extent(static_cast<double>(width) / height);
  extent.extend(bounds);
  camera.fit(extent);
  painter.set_scene(bounds, camera);
  std::array<Image, 2> pictures;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    painter.set_background(i == 0 ? cli::Colour{0, 0, 0} : cli::Colour{1, 1, 1});
    painter.begin();
    painter.draw(frame, PicturePainter::Which::kShown, cli::ColourMap::kViridis, {0, 0, width, height});
    pictures[i] = painter.finish();
  }
  return without_background(pictures[0], pictures[1]);
}

}  // namespace tvg::player
