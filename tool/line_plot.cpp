#include "tool/line_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

constexpr double kWidth = 720, kHeight = 460;
constexpr double kLeft = 64, kRight = 190, kTop = 34, kBottom = 52;
constexpr std::array<const char*, 10> kColours = {"#000000", "#0072b2", "#d55e00", "#e69f00", "#009e73",
                                                  "#cc79a7", "#7f7f7f", "#56b4e9", "#882255", "#999933"};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return result;
}

/// What an axis covers.
class Range {
 public:
  explicit Range(bool logarithmic) : logarithmic_(logarithmic) {}

  bool has_place_for(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }

  void add(double value) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }

  /// Room beyond the outermost points; zero is shown where it is near.
  void round_off() {
    if (!(low_ <= high_)) low_ = high_ = 1;
    if (logarithmic_) {
      constexpr double kMargin = 1.15;
      low_ /= kMargin;
      high_ *= kMargin;
      return;
    }
    if (low_ > 0 && low_ < 0.5 * high_) low_ = 0;
    if (high_ == low_) high_ = low_ + (low_ == 0 ? 1 : std::abs(low_));
    high_ += 0.05 * (high_ - low_);
  }

  /// 0 at the low end to 1 at the high one.
  double place(double value) const {
    return logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
  }

  std::vector<double> ticks() const {
    std::vector<double> result;
    if (logarithmic_) {
      const int last = static_cast<int>(std::floor(std::log10(high_)));
      const int first = static_cast<int>(std::floor(std::log10(low_)));
      for (int decade = first; decade <= last; ++decade) {
        for (const double factor : {1.0, 2.0, 5.0}) {
          if (last - first > 4 && factor != 1) continue;
          const double tick = factor * std::pow(10, decade);
          if (tick >= low_ && tick <= high_) result.push_back(tick);
        }
      }
      return result;
    }
    const double step = tick_step();
    // Multiples of the step, so that no rounding adds up.
    for (double i = std::ceil(low_ / step); i * step <= high_; ++i) result.push_back(i * step);
    return result;
  }

 private:
  /// 1, 2 or 5 times a power of ten, for at most eight ticks.
  double tick_step() const {
    const double wanted = (high_ - low_) / 8;
    const double decade = std::pow(10, std::floor(std::log10(wanted)));
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor * decade >= wanted) return factor * decade;
    }
    return 10 * decade;
  }

  bool logarithmic_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
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

class PlotDrawing {
 public:
  PlotDrawing(const LinePlot& plot, double top) : plot_(plot), top_(top) {
    for (const PlotCurve& curve : plot.curves) {
      for (const auto& [x, y] : curve.points) {
        if (!across_.has_place_for(x) || !up_.has_place_for(y)) continue;
        across_.add(x);
        up_.add(y);
      }
    }
    across_.round_off();
    up_.round_off();
  }

  std::string svg() const {
    const double middle = (kLeft + kWidth - kRight) / 2;
    std::string svg = fmt::format(
        "<text x=\"{}\" y=\"{}\" font-size=\"14\">{}</text>\n"
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n"
        "<text transform=\"translate(14 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        kLeft, top_ + 20, escaped(plot_.title), middle, top_ + kHeight - 12, escaped(plot_.x.label),
        (upper() + lower()) / 2, escaped(plot_.y.label));
    svg += axes();
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) svg += curve(i);
    return svg;
  }

 private:
  double upper() const { return top_ + kTop; }
  double lower() const { return top_ + kHeight - kBottom; }
  double x(double value) const { return kLeft + across_.place(value) * (kWidth - kLeft - kRight); }
  double y(double value) const { return lower() - up_.place(value) * (lower() - upper()); }

  std::string axes() const {
    const double right = kWidth - kRight;
    std::string svg =
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n",
                    kLeft, upper(), right - kLeft, lower() - upper());
    for (const double tick : across_.ticks()) {
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#ddd\"/>"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:.4g}</text>\n",
          x(tick), upper(), lower(), lower() + 16, tick);
    }
    for (const double tick : up_.ticks()) {
      svg += fmt::format(
          "<line x1=\"{0}\" y1=\"{1:.1f}\" x2=\"{2}\" y2=\"{1:.1f}\" stroke=\"#ddd\"/>"
          "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:.4g}</text>\n",
          kLeft, y(tick), right, kLeft - 6, y(tick) + 4, tick);
    }
    return svg;
  }

  /// A curve and its line of the legend; nothing where it has no points.
  std::string curve(std::size_t number) const {
    std::string places, marks;
    std::size_t count = 0;
    for (const auto& [across, up] : plot_.curves[number].points) {
      if (!across_.has_place_for(across) || !up_.has_place_for(up)) continue;
      ++count;
      places += fmt::format("{:.1f},{:.1f} ", x(across), y(up));
      if (plot_.marks) marks += mark(x(across), y(up), number);
    }
    if (count == 0) return "";
    const double at = kWidth - kRight + 12, height = upper() + 12 + 20 * static_cast<double>(number);
    const bool lone = count < 2;
    if (lone || plot_.marks) marks += mark(at + 12, height, number);
    const std::string sample = fmt::format("{},{} {},{}", at, height, at + 24, height);
    return (lone ? "" : line(places, number) + line(sample, number)) + marks +
           fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", at + 32, height + 4,
                       escaped(plot_.curves[number].name));
  }

  const LinePlot& plot_;
  double top_;
  Range across_{plot_.x.logarithmic}, up_{plot_.y.logarithmic};
};

}  // namespace

std::string plot_svg(const std::vector<LinePlot>& plots) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      kWidth, kHeight * static_cast<double>(plots.size()));
  for (std::size_t i = 0; i < plots.size(); ++i)
    svg += PlotDrawing(plots[i], kHeight * static_cast<double>(i)).svg();
  return svg + "</svg>\n";
}

}  // namespace tvg::cli
