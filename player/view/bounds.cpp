#include "player/view/bounds.hpp"

namespace tvg::player {

double view_radius(const BoundingBox& bounds) {
  const double radius = bounds.diagonal() / 2;
  return radius > 0 ? radius : 1;
}

}  // namespace tvg::player
