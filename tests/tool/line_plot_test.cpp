#include "tool/line_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace tvg::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(LinePlot, DrawsEveryCurveAndNamesIt) {
  const std::string svg =
      plot_svg({{"title", {"frames"}, {"error"}, {{"one", {{0, 1}, {1, 2}}}, {"two", {{0, 3}, {2, 4}}}}}});
  EXPECT_EQ(count(svg, "<polyline"), 4U);  // the curves, and their lines of the legend
  for (const char* words : {">title<", ">frames<", ">error<", ">one<", ">two<"})
    EXPECT_THAT(svg, HasSubstr(words));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
}

TEST(LinePlot, PlotsStandOneBelowTheOther) {
  const LinePlot plot{"p", {"x"}, {"y"}, {{"c", {{0, 1}, {1, 2}}}}};
  EXPECT_THAT(plot_svg({plot}), HasSubstr("viewBox=\"0 0 720 460\""));
  EXPECT_THAT(plot_svg({plot, plot}), HasSubstr("viewBox=\"0 0 720 920\""));
}

TEST(LinePlot, PointsWithoutAPlaceAreLeftOut) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const LinePlot plot{
      "p", {"x", true}, {"y", true}, {{"c", {{0, 1}, {1, 0}, {1, kInfinity}, {1, 1}, {10, 10}}}}};
  const std::string svg = plot_svg({plot});
  EXPECT_EQ(count(svg, "<circle"), 3U);  // two points and the legend
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(LinePlot, DrawsWhatHasNoExtent) {
  for (const bool logarithmic : {false, true}) {
    const LinePlot plot{"p", {"x", logarithmic}, {"y", logarithmic}, {{"none", {}}, {"lone", {{3, 3}}}}};
    const std::string svg = plot_svg({plot});
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr(">none<")));
    EXPECT_THAT(svg, HasSubstr(">lone<"));
  }
  EXPECT_THAT(plot_svg({{"p", {"x"}, {"y"}, {{"zero", {{0, 0}, {1, 0}}}}}}), Not(HasSubstr("nan")));
}

TEST(LinePlot, NamesAreTextWhateverTheyHold) {
  const std::string svg = plot_svg({{"a<b>&c", {"x"}, {"y"}, {{"c", {{0, 1}}}}}});
  EXPECT_THAT(svg, HasSubstr(">a&lt;b&gt;&amp;c<"));
}

}  // namespace
}  // namespace tvg::cli
