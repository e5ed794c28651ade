#pragma once
#include "bench/measure/experiment.hpp"

#include <string>
#include <vector>

namespace tvg::bench {

/// An SVG of one figure against file size, both logarithmic: a line per curve, and dashed the time-sharing
/// between encodings of the uniform curve that lie `coarser_bits` apart.
std::string plot_svg(const std::string& title, const Curve& uniform, const std::vector<Curve>& marked,
                     Figure figure, int coarser_bits);

}  // namespace tvg::bench
