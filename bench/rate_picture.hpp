#pragma once
#include <string>
#include <vector>

namespace tvg::bench {

struct PicturePoint {
  double error = 0;  ///< above 0
  double rate = 0;   ///< bits per vertex and frame, above 0
};

/// A line with its marks, or a lone mark, in the legend under `name`.
struct PictureCurve {
  std::string name;
  std::vector<PicturePoint> points;
};

/// An SVG of rates against errors, both logarithmic. Every curve has its colour and mark by its place in the
/// list, so that pictures of the same curves can be compared.
std::string rate_picture(const std::string& title, const std::string& error_label,
                         const std::vector<PictureCurve>& curves);

}  // namespace tvg::bench
