#include "bench/measure/plot.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tvg::bench {

namespace {

constexpr double kWidth = 560, kHeight = 400;
constexpr double kLeft = 70, kRight = 150, kTop = 34, kBottom = 44;
constexpr std::array<const char*, 8> kColours = {"#000000", "#0072b2", "#d55e00", "#009e73",
                                                 "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f"};

/// Maps both logarithms to the picture.
class Axes {
 public:
  Axes(const std::vector<const Curve*>& curves, Figure figure) : figure_(figure) {
    for (const Curve* curve : curves) {
      for (const Point& point : curve->points) {
        const double x = point.bytes, y = point.figures[figure];
        low_x_ = std::min(low_x_, x), high_x_ = std::max(high_x_, x);
        low_y_ = std::min(low_y_, y), high_y_ = std::max(high_y_, y);
      }
    }
  }

  double x(double bytes) const {
    return kLeft + std::log(bytes / low_x_) / std::log(high_x_ / low_x_) * (kWidth - kLeft - kRight);
  }
  double y(double value) const {
    return kHeight - kBottom -
           std::log(value / low_y_) / std::log(high_y_ / low_y_) * (kHeight - kTop - kBottom);
  }
  std::string place(const Point& point) const {
    return fmt::format("{:.1f},{:.1f}", x(point.bytes), y(point.figures[figure_]));
  }

  /// Frame, and ticks at some simple multiples of powers of ten.
  std::string drawing() const {
    std::string svg =
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n",
                    kLeft, kTop, kWidth - kLeft - kRight, kHeight - kTop - kBottom);
    for (const double tick : ticks(low_x_, high_x_)) {
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#ddd\"/>"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:.0f}</text>\n",
          x(tick), kTop, kHeight - kBottom, kHeight - kBottom + 16, tick / 1000);
    }
    for (const double tick : ticks(low_y_, high_y_)) {
      svg += fmt::format(
          "<line x1=\"{0}\" y1=\"{1:.1f}\" x2=\"{2}\" y2=\"{1:.1f}\" stroke=\"#ddd\"/>"
          "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:.2g}</text>\n",
          kLeft, y(tick), kWidth - kRight, kLeft - 6, y(tick) + 4, tick);
    }
    return svg;
  }

 private:
  static std::vector<double> ticks(double low, double high) {
    std::vector<double> result;
    const int last = static_cast<int>(std::floor(std::log10(high)));
    for (int decade = static_cast<int>(std::floor(std::log10(low))); decade <= last; ++decade) {
      for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0}) {
        const double tick = factor * std::pow(10, decade);
        if (tick >= low && tick <= high) result.push_back(tick);
      }
    }
    return result;
  }

  Figure figure_;
  double low_x_ = std::numeric_limits<double>::infinity(), high_x_ = 0;
  double low_y_ = std::numeric_limits<double>::infinity(), high_y_ = 0;
};

std::string polyline(const std::string& places, const char* colour, const char* dash) {
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"{}/>\n", places,
                     colour, dash);
}

std::string legend(const std::string& name, std::size_t line, const char* colour, const char* dash) {
  const double y = kTop + 10 + 18 * static_cast<double>(line);
  const double x = kWidth - kRight + 10;
  return polyline(fmt::format("{},{} {},{}", x, y, x + 22, y), colour, dash) +
         fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x + 28, y + 4, name);
}

constexpr const char* kSolid = "";
constexpr const char* kDashed = " stroke-dasharray=\"5 4\"";

/// The time-sharing lines; points of the uniform curve must lie `coarser_bits` apart.
std::string sharing_lines(const Axes& axes, const Curve& uniform, int coarser_bits) {
  constexpr int kSteps = 16;
  std::string svg;
  for (const Point& coarse : uniform.points) {
    for (const Point& fine : uniform.points) {
      if (std::abs(fine.bits - coarse.bits - coarser_bits) > 1e-9) continue;
      std::string places;
      for (int step = 0; step <= kSteps; ++step) {
        const double bytes = coarse.bytes + (fine.bytes - coarse.bytes) * step / kSteps;
        places += axes.place(time_sharing(coarse, fine, bytes)) + " ";
      }
      svg += polyline(places, kColours[0], kDashed);
    }
  }
  return svg;
}

}  // namespace

std::string plot_svg(const std::string& title, const Curve& uniform, const std::vector<Curve>& marked,
                     Figure figure, int coarser_bits) {
  std::vector<const Curve*> curves = {&uniform};
  for (const Curve& curve : marked) curves.push_back(&curve);
  const Axes axes(curves, figure);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"{2}\" y=\"20\" font-size=\"14\">{3}</text>\n"
      "<text x=\"{4}\" y=\"{5}\" text-anchor=\"middle\">file size, kB</text>\n",
      kWidth, kHeight, kLeft, title, (kLeft + kWidth - kRight) / 2, kHeight - 8);
  svg += axes.drawing() + sharing_lines(axes, uniform, coarser_bits);
  std::size_t line = 0;
  for (const Curve* curve : curves) {
    const char* colour = kColours[line % kColours.size()];
    std::string places;
    for (const Point& point : curve->points) places += axes.place(point) + " ";
    svg += polyline(places, colour, kSolid) + legend(curve->name, line++, colour, kSolid);
  }
  svg += legend("time-sharing", line, kColours[0], kDashed);
  return svg + "</svg>\n";
}

}  // namespace tvg::bench
