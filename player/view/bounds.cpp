#include "player/view/bounds.hpp"

namespace tvg::player {

UpAxis up_axis_of(const Metadata& metadata) {
  const auto up = metadata.find("up");
  return up != metadata.end() && up->second == "z" ? UpAxis::kZ : UpAxis::kY;
}

double view_radius(const BoundingBox& bounds) {
  const double radius = bounds.diagonal() / 2;
  return radius > 0 ? radius : 1;
}

}  // namespace tvg::player
