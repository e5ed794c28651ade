#pragma once
#include <string>
#include <utility>
#include <vector>

namespace tvg::cli {

struct PlotAxis {
  std::string label;
  bool logarithmic = false;
};

/// A line, or a lone mark, in the legend under `name`.
struct PlotCurve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< (x, y)
};

/// Curves in one frame. Points that an axis has no place for (infinite, or not above 0 on a logarithmic one)
/// are left out.
struct LinePlot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotCurve> curves;
  bool marks = true;  ///< at every point
};

/// An SVG of plots, one below the other. A curve has its colour and mark by its place in its list, so that
/// pictures of the same curves can be compared.
std::string plot_svg(const std::vector<LinePlot>& plots);

}  // namespace tvg::cli
