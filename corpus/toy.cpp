#include "corpus/corpus.hpp"
#include "corpus/exact_math.hpp"
#include "corpus/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

// The toy: a gear train over a base plate, with wheels, pistons, tumbling blocks and bouncing balls. Units:
// cm.
namespace tvg::corpus {
namespace {

/// A component and its motion from rest.
struct Part {
  Surface surface;
  std::function<Pose(double seconds)> pose;
};

void stretch(Surface& surface, const Vec3& factors) {
  for (Vec3& p : surface.points) p = {p.x * factors.x, p.y * factors.y, p.z * factors.z};
}

/// A toothed ring about the z axis; `pitch_radius` is where it meets the next gear.
Surface make_gear(std::uint32_t teeth, double pitch_radius, std::uint32_t detail) {
  const std::uint32_t around = teeth * 2 * detail;
  return make_ring(around, 4 * detail, [=](double turn, double section) {
    // Half a sample on, so that the coarsest gear has its samples on crests and in gaps.
    const double angle = turn + 0.5 / around;
    const double tooth = std::clamp(1.6 * sine(teeth * angle), -1.0, 1.0);
    const double outer = pitch_radius + 0.32 * tooth;
    const double inner = 0.35 * pitch_radius;
    const double side =
        4 * section;  // once around a rectangle: bottom outwards, outer rim, top inwards, inner rim
    double radius = inner;
    double z = -0.6;
    if (side < 1) {
      radius = inner + side * (outer - inner);
    } else if (side < 2) {
      radius = outer;
      z = -0.6 + 1.2 * (side - 1);
    } else if (side < 3) {
      radius = outer - (side - 2) * (outer - inner);
      z = 0.6;
    } else {
      z = 0.6 - 1.2 * (side - 3);
    }
    return Vec3{radius * cosine(angle), radius * sine(angle), z};
  });
}

Surface make_wheel(double radius, double tube, std::uint32_t detail) {
  return make_ring(6 * detail, 3 * detail, [=](double turn, double section) {
    const double r = radius + tube * cosine(section);
    return Vec3{r * cosine(turn), r * sine(turn), tube * sine(section)};
  });
}

/// A rod along y of length 2 and radius 1 with flat ends.
Surface make_rod(std::uint32_t detail) {
  Surface rod = make_cube(detail);
  for (Vec3& p : rod.points)
    p = {p.x * std::sqrt(1 - p.z * p.z / 2), p.y, p.z * std::sqrt(1 - p.x * p.x / 2)};
  return rod;
}

/// Gears in a row along x, each driven by the one before: tooth against gap at every contact.
void add_gears(std::vector<Part>& parts, std::uint32_t detail) {
  constexpr std::array<std::uint32_t, 8> kTeeth = {8, 6, 10, 7, 12, 6, 9, 8};
  double x = -13;
  double start = 0;
  double speed = 0.5;  // turns per second, counter-clockwise
  for (std::size_t i = 0; i < kTeeth.size(); ++i) {
    const double radius = 0.25 * kTeeth[i];
    if (i > 0) {
      const double before = 0.25 * kTeeth[i - 1];
      x += before + radius;
      // The phases of both outlines at the contact must add up to a whole number of teeth.
      start = 0.5 - kTeeth[i - 1] * start / kTeeth[i];
      speed = -speed * kTeeth[i - 1] / kTeeth[i];
    }
    parts.push_back(
        {make_gear(kTeeth[i], radius, detail), [=](double seconds) {
           return translation_by({x, 6, 0}).after(rotation_about({}, {0, 0, 1}, start + speed * seconds));
         }});
  }
}

/// Four wheels that roll along x and back below the plate.
void add_wheels(std::vector<Part>& parts, std::uint32_t detail) {
  constexpr double kRadius = 1.4;
  constexpr double kTube = 0.5;
  for (int i = 0; i < 4; ++i) {
    parts.push_back({make_wheel(kRadius, kTube, detail), [i](double seconds) {
                       const double way = 2.5 * sine(0.3 * seconds + 0.07 * i);
                       const Vec3 centre{i % 2 == 0 ? -8.0 + way : 8.0 + way, -2.4, i < 2 ? -4.0 : 4.0};
                       const double turns = -way / (6.283185307179586 * (kRadius + kTube));
                       return translation_by(centre).after(rotation_about({}, {0, 0, 1}, turns));
                     }});
  }
}

/// Twelve blocks on a round course over the plate, each tumbling about an axis of its own.
void add_blocks(std::vector<Part>& parts, std::uint32_t detail) {
  Random random(20240601);
  for (int i = 0; i < 12; ++i) {
    Surface block = make_cube(detail);
    stretch(block,
            {0.4 + 0.5 * random.uniform(), 0.4 + 0.4 * random.uniform(), 0.4 + 0.3 * random.uniform()});
    const Vec3 axis = normalized({random.uniform() - 0.5, random.uniform() + 0.2, random.uniform() - 0.5});
    const double speed = 0.2 + 0.4 * random.uniform();
    const double place = i / 12.0;
    parts.push_back({std::move(block), [=](double seconds) {
                       const double course = place + 0.12 * seconds;
                       const Vec3 centre{12 * cosine(course), 2.0 + 0.6 * sine(3 * course), 6 * sine(course)};
                       return translation_by(centre).after(rotation_about({}, axis, speed * seconds));
                     }});
  }
}

/// Six balls that bounce on the plate, spinning.
void add_balls(std::vector<Part>& parts, std::uint32_t detail) {
  constexpr double kRadius = 0.8;
  for (int i = 0; i < 6; ++i) {
    Surface ball = make_ball(detail);
    stretch(ball, {kRadius, kRadius, kRadius});
    const double period = 0.8 + 0.11 * i;
    parts.push_back({std::move(ball), [=](double seconds) {
                       const double beat = seconds / period + 0.17 * i;
                       const double s = beat - std::floor(beat);
                       const double height = 4 * s * (1 - s) * 4 * period * period;
                       const Vec3 centre{-10.0 + 4 * i, 0.5 + kRadius + height, -3.0};
                       return translation_by(centre).after(rotation_about({}, {0.6, 0, 0.8}, 0.4 * seconds));
                     }});
  }
}

/// Four pistons and the rocker above them.
void add_pistons(std::vector<Part>& parts, std::uint32_t detail) {
  for (int i = 0; i < 4; ++i) {
    Surface rod = make_rod(detail);
    stretch(rod, {0.5, 1.8, 0.5});
    parts.push_back({std::move(rod), [i](double seconds) {
                       const double lift = 1.2 * sine(0.9 * seconds + 0.25 * i);
                       return translation_by({-4.5 + 3 * i, 2.8 + lift, 3.0});
                     }});
  }
  Surface rocker = make_cube(detail);
  stretch(rocker, {6.5, 0.3, 0.6});
  parts.push_back({std::move(rocker), [](double seconds) {
                     return translation_by({0, 7.2, 3.0})
                         .after(rotation_about({}, {0, 0, 1}, 0.03 * sine(0.9 * seconds)));
                   }});
}

std::vector<Part> make_parts(std::uint32_t detail) {
  std::vector<Part> parts;
  Surface plate = make_cube(detail);
  stretch(plate, {15, 0.5, 8});
  parts.push_back({std::move(plate), [](double) { return Pose{}; }});
  add_gears(parts, detail);
  add_wheels(parts, detail);
  add_blocks(parts, detail);
  add_balls(parts, detail);
  add_pistons(parts, detail);
  return parts;
}

/// Vertices of make_parts(detail): a constant and a square for cubes, a square for rings.
std::uint64_t vertices_at(std::uint32_t detail) {
  constexpr std::uint64_t kTeethInAll = 66;
  constexpr std::uint64_t kCubes = kToyPartCount - 8 - 4;
  const std::uint64_t square = std::uint64_t{detail} * detail;
  return kTeethInAll * 8 * square + 4 * 18 * square + kCubes * (6 * square + 2);
}

}  // namespace

Sequence make_toy(const SequenceSize& size) {
  std::uint32_t detail = 1;
  while (vertices_at(detail) + vertices_at(detail + 1) < std::uint64_t{size.vertices} * 2) ++detail;
  const std::vector<Part> parts = make_parts(detail);
  Surface whole;
  for (const Part& part : parts) whole.append(part.surface);
  Sequence toy;
  toy.mesh = {whole.size(), whole.faces};
  std::vector<Vec3> points;
  for (std::uint32_t frame = 0; frame < size.frames; ++frame) {
    points.clear();
    for (const Part& part : parts) {
      const Pose pose = part.pose(frame / 30.0);
      for (const Vec3& p : part.surface.points) points.push_back(pose.apply(p));
    }
    toy.frames.push_back(to_frame(points));
  }
  toy.metadata = {{"name", "toy"}, {"fps", "30"}, {"units", "cm"}, {"up", "y"}};
  return toy;
}

}  // namespace tvg::corpus
