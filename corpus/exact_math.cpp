#include "corpus/exact_math.hpp"

namespace tvg::corpus {

Pose Pose::after(const Pose& inner) const {
  const Vec3 column_x{inner.row_x.x, inner.row_y.x, inner.row_z.x};
  const Vec3 column_y{inner.row_x.y, inner.row_y.y, inner.row_z.y};
  const Vec3 column_z{inner.row_x.z, inner.row_y.z, inner.row_z.z};
  Pose product;
  product.row_x = {dot(row_x, column_x), dot(row_x, column_y), dot(row_x, column_z)};
  product.row_y = {dot(row_y, column_x), dot(row_y, column_y), dot(row_y, column_z)};
  product.row_z = {dot(row_z, column_x), dot(row_z, column_y), dot(row_z, column_z)};
  product.translation = apply(inner.translation);
  return product;
}

Pose rotation_about(const Vec3& centre, const Vec3& axis, double turns) {
  const double c = cosine(turns);
  const double s = sine(turns);
  const double k = 1 - c;
  Pose pose;
  pose.row_x = {c + k * axis.x * axis.x, k * axis.x * axis.y - s * axis.z, k * axis.x * axis.z + s * axis.y};
  pose.row_y = {k * axis.y * axis.x + s * axis.z, c + k * axis.y * axis.y, k * axis.y * axis.z - s * axis.x};
  pose.row_z = {k * axis.z * axis.x - s * axis.y, k * axis.z * axis.y + s * axis.x, c + k * axis.z * axis.z};
  pose.translation = centre - pose.turn(centre);
  return pose;
}

}  // namespace tvg::corpus
