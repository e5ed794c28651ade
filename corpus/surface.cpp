#include "corpus/surface.hpp"

#include <map>
#include <tuple>

namespace tvg::corpus {

std::uint32_t Surface::add_point(const Vec3& point) {
  points.push_back(point);
  return size() - 1;
}

void Surface::add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  faces.push_back({a, b, c});
  faces.push_back({a, c, d});
}

void Surface::append(const Surface& other) {
  const std::uint32_t shift = size();
  points.insert(points.end(), other.points.begin(), other.points.end());
  for (const Face& face : other.faces) faces.push_back({face[0] + shift, face[1] + shift, face[2] + shift});
}

Surface make_cube(std::uint32_t cells) {
  Surface cube;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> index;
  const auto coordinate = [cells](std::uint32_t i) { return 2.0 * i / cells - 1; };
  const auto vertex = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const auto [entry, is_new] = index.try_emplace({x, y, z}, cube.size());
    if (is_new) cube.add_point({coordinate(x), coordinate(y), coordinate(z)});
    return entry->second;
  };
  // A side lies across one axis; (i, j) run along the next two, so that i x j points along the axis.
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    for (const std::uint32_t level : {0U, cells}) {
      const auto on_side = [&](std::uint32_t i, std::uint32_t j) {
        if (axis == 0) return vertex(level, i, j);
        if (axis == 1) return vertex(j, level, i);
        return vertex(i, j, level);
      };
      for (std::uint32_t i = 0; i < cells; ++i) {
        for (std::uint32_t j = 0; j < cells; ++j) {
          const std::uint32_t a = on_side(i, j);
          const std::uint32_t b = on_side(i + 1, j);
          const std::uint32_t c = on_side(i + 1, j + 1);
          const std::uint32_t d = on_side(i, j + 1);
          if (level == 0) {
            cube.add_quad(a, d, c, b);
          } else {
            cube.add_quad(a, b, c, d);
          }
        }
      }
    }
  }
  return cube;
}

Surface make_ball(std::uint32_t cells) {
  Surface ball = make_cube(cells);
  for (Vec3& point : ball.points) point = normalized(point);
  return ball;
}

Surface make_ring(std::uint32_t around, std::uint32_t across,
                  const std::function<Vec3(double, double)>& point) {
  Surface ring;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      ring.add_point(point(static_cast<double>(i) / around, static_cast<double>(j) / across));
      const std::uint32_t next_i = (i + 1) % around;
      const std::uint32_t next_j = (j + 1) % across;
      ring.add_quad(i * across + j, next_i * across + j, next_i * across + next_j, i * across + next_j);
    }
  }
  return ring;
}

FramePositions to_frame(std::span<const Vec3> points) {
  FramePositions frame;
  frame.reserve(points.size() * 3);
  for (const Vec3& point : points) {
    for (const double value : {point.x, point.y, point.z}) frame.push_back(static_cast<float>(value));
  }
  return frame;
}

}  // namespace tvg::corpus
