#include "tests/view/pictures.hpp"

#include "corpus/corpus.hpp"
#include "player/overlay/overlay_values.hpp"
#include "player/render/sheet.hpp"
#include "tests/view/view_toolbox.hpp"

#include <array>

#include <tvg/decoder.hpp>
#include <tvg/encoder.hpp>

namespace tvg::player::testing {

namespace {

constexpr std::uint32_t kFrames = 12;

Sequence corpus_sequence(std::string_view name, std::uint32_t vertices) {
  return corpus::find_corpus_entry(name)->make({vertices, kFrames}).sequence;
}

Image draw(const Sequence& sequence, const ShownFrame& frame, const Style& style,
           cli::ColourMap map = cli::ColourMap::kViridis) {
  PicturePainter painter(kWidth, kHeight, style, false);
  painter.set_scene(bounds_of(sequence), camera_for(sequence, static_cast<double>(kWidth) / kHeight));
  painter.begin();
  painter.draw(frame, PicturePainter::Which::kShown, map, {0, 0, kWidth, kHeight});
  return painter.finish();
}

Image draw_smooth() {
  return draw_hand(5);
}

Image draw_flat() {
  const Sequence toy = corpus_sequence("toy", 2000);
  Style style;
  style.shading = Shading::kFlat;
  style.grid = true;
  return draw(toy, shown_frame(toy, 3), style);
}

Image draw_wireframe() {
  const Sequence face = corpus_sequence("face", 500);
  Style style;
  style.wireframe = true;
  return draw(face, shown_frame(face, 6), style);
}

/// The flags of a real stream, as a player gets them.
Image draw_importance() {
  const Sequence hand = corpus_sequence("hand", 1600);
  EncodeOptions options;
  options.fine_bits = 12;
  options.coarse_bits = 9;
  options.importance.share = 0.35;
  Decoder decoder;
  SequenceSource source(hand);
  static_cast<void>(encode(source, options, [&decoder](std::span<const std::uint8_t> bytes) {
    decoder.push(bytes);
    return Status();
  }));
  decoder.finish();
  while (decoder.poll() != Decoder::Event::kFrame) {
  }
  ShownFrame frame = shown_frame(hand, 0);
  std::vector<std::uint8_t> flags(hand.mesh.vertex_count);
  decoder.copy_flags(flags);
  decoder.copy_positions(frame.positions.data());
  frame.values.resize(flags.size());
  importance_values(flags, frame.values);
  return draw(hand, frame, {}, cli::ColourMap::kFlags);
}

Image draw_cost() {
  const Sequence cloth = corpus_sequence("cloth", 2000);
  ShownFrame frame = shown_frame(cloth, kFrames - 1);
  frame.values = cost_values(cloth.mesh, {cloth.frames});
  std::vector<float> scratch;
  cli::scale_values(frame.values, {0, cli::value_at_share(frame.values, 0.95, scratch)});
  return draw(cloth, frame, {});
}

Image draw_sheet() {
  const Sequence hand = corpus_sequence("hand", 1600);
  PicturePainter painter(kWidth, kHeight, {}, false);
  const std::vector<Cell> cells = sheet_cells(kWidth, kHeight, 3, 2);
  painter.set_scene(bounds_of(hand), camera_for(hand, static_cast<double>(cells[0].width) / cells[0].height));
  painter.begin();
  const std::vector<std::uint64_t> chosen = spread_evenly(kFrames, cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    painter.draw(shown_frame(hand, chosen[i]), PicturePainter::Which::kShown, cli::ColourMap::kViridis,
                 cells[i]);
  }
  return painter.finish();
}

/// A hand that lies on its side, on the ground below it, and the axes without letters, which fonts differ in.
Image draw_axes() {
  const Sequence hand = corpus_sequence("hand", 1600);
  Style style;
  style.grid = true;
  OrbitCamera camera;
  camera.set_orientation({{0, -1}, {2, 1}});
  ViewExtent extent = camera.extent(static_cast<double>(kWidth) / kHeight);
  extent.extend(hand.frames[5]);
  camera.fit(extent);
  PicturePainter painter(kWidth, kHeight, style, false, true);
  painter.set_scene(extent.bounds(), camera);
  painter.begin();
  const Cell whole = {0, 0, kWidth, kHeight};
  painter.draw(shown_frame(hand, 5), PicturePainter::Which::kShown, cli::ColourMap::kViridis, whole);
  painter.axes(whole);
  return painter.finish();
}

/// A cloth by colours of the frame, red to green from the first vertex to the last, and some blue.
Image draw_frame_colours() {
  const Sequence cloth = corpus_sequence("cloth", 800);
  MeshProperties properties;
  Attribute colours;
  colours.kind = AttributeKind::kColour;
  colours.components = 3;
  colours.animated = true;
  colours.values.assign(3 * std::size_t{cloth.mesh.vertex_count}, 0);
  properties.attributes = {colours};
  ShownFrame frame = shown_frame(cloth, 3);
  frame.surface = make_surface(cloth.mesh, properties, {});
  for (std::uint32_t v = 0; v < cloth.mesh.vertex_count; ++v) {
    const float share = static_cast<float>(v) / static_cast<float>(cloth.mesh.vertex_count);
    frame.colours.insert(frame.colours.end(), {1 - share, share, v % 40 == 0 ? 1.0F : 0.0F});
  }
  return draw(cloth, frame, {});
}

constexpr std::array<StoredPicture, 8> kPictures = {{{"smooth", draw_smooth},
                                                     {"flat", draw_flat},
                                                     {"wireframe", draw_wireframe},
                                                     {"importance", draw_importance},
                                                     {"cost", draw_cost},
                                                     {"axes", draw_axes},
                                                     {"colours", draw_frame_colours},
                                                     {"sheet", draw_sheet}}};

}  // namespace

std::span<const StoredPicture> stored_pictures() {
  return kPictures;
}

Image draw_hand(std::size_t frame) {
  const Sequence hand = corpus_sequence("hand", 1600);
  return draw(hand, shown_frame(hand, frame), {});
}

Image draw_hand_without_some_faces() {
  const Sequence hand = corpus_sequence("hand", 1600);
  ShownFrame frame = shown_frame(hand, 5);
  Mesh holed = hand.mesh;
  // One face in a hundred, all over the hand, so that some of them are in sight.
  for (std::size_t f = 0; f < holed.faces.size(); f += 100) holed.faces[f] = {0, 0, 0};
  frame.mesh = std::make_shared<const Mesh>(std::move(holed));
  return draw(hand, frame, {});
}

Image draw_hand_in_another_colour() {
  const Sequence hand = corpus_sequence("hand", 1600);
  Style style;
  style.surface.red -= 0.06F;
  return draw(hand, shown_frame(hand, 5), style);
}

}  // namespace tvg::player::testing
