#include "cli/criterion_options.hpp"

#include "encoder/importers/vertex_weights.hpp"
#include "tool/option_values.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

void set_alpha(const std::string& text, Importance& importance) {
  importance.curv.alpha = parse_number("--alpha", text, {0, 1});
}

void set_skel_alpha(const std::string& text, Importance& importance) {
  importance.skel.alpha = parse_number("--skel-alpha", text, {0, 1});
}

void set_skel_threshold(const std::string& text, Importance& importance) {
  importance.skel.threshold = parse_number("--skel-threshold", text, {0});
}

void set_skel_region(const std::string& text, Importance& importance) {
  if (text != "nearest" && text != "weights") fail_option("--skel-region", text, "write nearest or weights");
  importance.skel.region = text == "weights" ? JointRegion::kHeaviest : JointRegion::kNearest;
}

void set_viewpoint(const std::string& text, Importance& importance) {
  const char* at = text.data();
  const char* end = text.data() + text.size();
  for (std::size_t k = 0; k < 3; ++k) {
    double& place = importance.distance.viewpoint[k];
    const auto [after, error] = std::from_chars(at, end, place);
    const bool separated = k < 2 ? after != end && *after == ',' : after == end;
    if (error != std::errc() || !separated || !std::isfinite(place)) {
      fail_option("--viewpoint", text, "write a place in the mesh's units as 0,1.5,-4");
    }
    at = after + 1;
  }
}

void set_weights(const std::string& text, Importance& importance) {
  importance.weights = read_vertex_weights(text);
}

}  // namespace

std::span<const CriterionOption> criterion_options() {
  static const std::array<CriterionOption, 6> options = {{
      {"--alpha",
       {"curv", "curvature-norm"},
       "NUMBER",
       fmt::format("of curv: weight of the change of curvature against its mean (default {})",
                   CurvatureOptions().alpha),
       set_alpha},
      {"--skel-alpha",
       {"skel"},
       "NUMBER",
       fmt::format("of skel: value at joints that bend; elsewhere it is 1 minus this (default {})",
                   SkeletonOptions().alpha),
       set_skel_alpha},
      {"--skel-threshold",
       {"skel"},
       "NUMBER",
       "of skel: degrees per frame above which a joint bends (default: a quarter of the strongest joint's, "
       "at "
       "least 0.1)",
       set_skel_threshold},
      {"--skel-region",
       {"skel"},
       "TEXT",
       "of skel: the joint of a vertex is the nearest (default) or that of its largest skin weight (weights)",
       set_skel_region},
      {"--viewpoint",
       {"distance"},
       "TEXT",
       "of distance: where it is measured from, as 0,1.5,-4",
       set_viewpoint,
       "say from where with --viewpoint, as --viewpoint 0,1.5,-4"},
      {"--weights",
       {"weights"},
       "TEXT",
       "of weights: a number per vertex, one on each line, or a .npy",
       set_weights,
       "name the file of the weights with --weights (text or .npy)"},
  }};
  return options;
}

}  // namespace tvg::cli
