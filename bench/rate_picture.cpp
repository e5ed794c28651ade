#include "bench/rate_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tvg::bench {

namespace {

constexpr double kWidth = 720, kHeight = 460;
constexpr double kLeft = 64, kRight = 190, kTop = 34, kBottom = 52;
constexpr double kMargin = 1.15;  ///< of both axes beyond the outermost points
constexpr std::array<const char*, 10> kColours = {"#000000", "#0072b2", "#d55e00", "#e69f00", "#009e73",
                                                  "#cc79a7", "#7f7f7f", "#56b4e9", "#882255", "#999933"};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;

  void add(double value) {
    low = std::min(low, value / kMargin);
    high = std::max(high, value * kMargin);
  }
  /// 0 at the low end to 1 at the high one, by the logarithm.
  double place(double value) const { return std::log(value / low) / std::log(high / low); }

  std::vector<double> ticks() const {
    std::vector<double> result;
    const int last = static_cast<int>(std::floor(std::log10(high)));
    for (int decade = static_cast<int>(std::floor(std::log10(low))); decade <= last; ++decade) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double tick = factor * std::pow(10, decade);
        if (tick >= low && tick <= high) result.push_back(tick);
      }
    }
    return result;
  }
};

struct Axes {
  Range errors, rates;

  double x(double error) const { return kLeft + errors.place(error) * (kWidth - kLeft - kRight); }
  double y(double rate) const { return kHeight - kBottom - rates.place(rate) * (kHeight - kTop - kBottom); }

  std::string drawing() const {
    const double right = kWidth - kRight, bottom = kHeight - kBottom;
    std::string svg =
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n",
                    kLeft, kTop, right - kLeft, bottom - kTop);
    for (const double tick : errors.ticks()) {
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#ddd\"/>"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
          x(tick), kTop, bottom, bottom + 16, tick);
    }
    for (const double tick : rates.ticks()) {
      svg += fmt::format(
          "<line x1=\"{0}\" y1=\"{1:.1f}\" x2=\"{2}\" y2=\"{1:.1f}\" stroke=\"#ddd\"/>"
          "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>\n",
          kLeft, y(tick), right, kLeft - 6, y(tick) + 4, tick);
    }
    return svg;
  }
};

/// Circles, squares and diamonds in turn, for those who do not see the colours.
std::string mark(double x, double y, std::size_t curve) {
  const char* colour = kColours[curve % kColours.size()];
  if (curve % 3 == 0)
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>", x, y, colour);
  const std::string turn = curve % 3 == 1 ? "" : fmt::format(" transform=\"rotate(45 {:.1f} {:.1f})\"", x, y);
  return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"7\" height=\"7\" fill=\"{}\"{}/>", x - 3.5,
                     y - 3.5, colour, turn);
}

std::string line(const std::string& places, std::size_t curve) {
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>", places,
                     kColours[curve % kColours.size()]);
}

std::string drawing(const Axes& axes, const PictureCurve& curve, std::size_t number) {
  std::string places, marks;
  for (const PicturePoint& point : curve.points) {
    places += fmt::format("{:.1f},{:.1f} ", axes.x(point.error), axes.y(point.rate));
    marks += mark(axes.x(point.error), axes.y(point.rate), number);
  }
  const double x = kWidth - kRight + 12, y = kTop + 12 + 20 * static_cast<double>(number);
  const bool lone = curve.points.size() < 2;
  return (lone ? "" : line(places, number) + line(fmt::format("{},{} {},{}", x, y, x + 24, y), number)) +
         marks + mark(x + 12, y, number) +
         fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x + 32, y + 4, curve.name);
}

}  // namespace

std::string rate_picture(const std::string& title, const std::string& error_label,
                         const std::vector<PictureCurve>& curves) {
  Axes axes;
  for (const PictureCurve& curve : curves) {
    for (const PicturePoint& point : curve.points) {
      axes.errors.add(point.error);
      axes.rates.add(point.rate);
    }
  }
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"{2}\" y=\"20\" font-size=\"14\">{3}: bits per vertex and frame, whole file</text>\n"
      "<text x=\"{4}\" y=\"{5}\" text-anchor=\"middle\">{6}</text>\n",
      kWidth, kHeight, kLeft, title, (kLeft + kWidth - kRight) / 2, kHeight - 12, error_label);
  svg += axes.drawing();
  for (std::size_t number = 0; number < curves.size(); ++number) {
    if (!curves[number].points.empty()) svg += drawing(axes, curves[number], number);
  }
  return svg + "</svg>\n";
}

}  // namespace tvg::bench
