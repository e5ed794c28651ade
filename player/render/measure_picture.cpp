#include "player/render/measure_picture.hpp"

#include "player/overlay/overlay_values.hpp"
#include "player/render/picture.hpp"
#include "player/view/image.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::player {

namespace {

Legend cost_legend(const std::string& criteria, const cli::ValueRange& range) {
  Legend legend;
  legend.map = cli::ColourMap::kViridis;
  legend.title = "cost";
  legend.note = criteria;
  legend.smallest = double{range.smallest};
  legend.largest = double{range.largest};
  return legend;
}

Legend flags_legend(const std::vector<std::uint8_t>& flags) {
  const auto important = static_cast<double>(std::count(flags.begin(), flags.end(), 1));
  Legend legend;
  legend.map = cli::ColourMap::kFlags;
  legend.title = "importance";
  legend.flagged = fmt::format("important ({:.1f} %)", 100 * important / static_cast<double>(flags.size()));
  legend.plain = "other";
  return legend;
}

}  // namespace

void draw_measure_picture(const std::string& path, const FrameSource& source, const cli::MeasuredFrame& frame,
                          const std::string& criteria, const Look& look) {
  const std::vector<Cell> cells = sheet_cells(look.width, look.height, 2, 1);
  OrbitCamera camera;
  camera.set_angles(look.angles);
  camera.set_orientation(look.orientation.of(source.metadata()));
  ViewExtent extent = camera.extent(static_cast<double>(cells[0].width) / cells[0].height);
  extent.extend(frame.positions);
  camera.fit(extent);
  PicturePainter painter(look.width, look.height, look.style, true, look.axes);
  painter.set_scene(extent.bounds(), camera);

  const cli::ValueRange range = cli::cost_range(frame.cost);
  ShownFrame shown;
  shown.number = frame.number;
  shown.mesh = std::make_shared<const Mesh>(source.mesh());
  shown.positions = frame.positions;
  shown.values = frame.cost;
  painter.begin();
  cli::scale_values(shown.values, range);
  painter.draw(shown, PicturePainter::Which::kShown, cli::ColourMap::kViridis, cells[0]);
  importance_values(frame.flags, shown.values);
  painter.draw(shown, PicturePainter::Which::kReference, cli::ColourMap::kFlags, cells[1]);
  if (!frame.joints.empty()) {
    for (const Cell& cell : cells) painter.pose({source.skeleton(), frame.joints, frame.dynamic}, cell);
    painter.label(cells[1], "orange joints bend");
  }
  painter.legend(cost_legend(criteria, range), cells[0]);
  painter.legend(flags_legend(frame.flags), cells[1]);
  painter.label(cells[0], fmt::format("frame {}", frame.number));
  painter.axes(cells[1]);
  write_png(path, painter.finish());
}

}  // namespace tvg::player
