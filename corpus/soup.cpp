#include "corpus/corpus.hpp"
#include "corpus/exact_math.hpp"
#include "corpus/surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

// The soup: parts that each break one rule of well-behaved meshes, shuffled together. Units: none.
namespace tvg::corpus {
namespace {

constexpr std::uint32_t kIsolated = 7;
constexpr std::uint32_t kPages = 3;

void move_to(Surface& surface, const Vec3& centre, double scale) {
  for (Vec3& p : surface.points) p = centre + scale * p;
}

/// A lumpy ball with two windows: boundaries, and edges and vertices of the usual kind.
Surface holed_ball(std::uint32_t detail) {
  Surface ball = make_ball(detail);
  for (Vec3& p : ball.points) p = (1 + 0.12 * sine(0.9 * p.x + 0.3) * sine(1.1 * p.y)) * p;
  std::erase_if(ball.faces, [&](const Face& face) {
    const Vec3 sum = ball.points[face[0]] + ball.points[face[1]] + ball.points[face[2]];
    return sum.z > 2.4 || sum.x + sum.y > 3.6;
  });
  return ball;
}

/// Vertices that no face uses are not left behind: they would count as isolated.
Surface without_unused(const Surface& surface) {
  std::vector<std::uint32_t> new_index(surface.points.size(), 0xFFFFFFFF);
  Surface packed;
  for (Face face : surface.faces) {
    for (std::uint32_t& v : face) {
      if (new_index[v] == 0xFFFFFFFF) new_index[v] = packed.add_point(surface.points[v]);
      v = new_index[v];
    }
    packed.faces.push_back(face);
  }
  return packed;
}

/// Pages of cells x cells quads that share one spine: `cells` edges with kPages faces each.
Surface book(std::uint32_t cells) {
  Surface pages;
  for (std::uint32_t i = 0; i <= cells; ++i) pages.add_point({0, 2.0 * i / cells - 1, 0});
  for (std::uint32_t page = 0; page < kPages; ++page) {
    const Vec3 out{cosine(0.13 * page - 0.1), 0, sine(0.13 * page - 0.1)};
    const std::uint32_t first = pages.size();
    const auto vertex = [&](std::uint32_t along, std::uint32_t off) {
      return off == 0 ? along : first + along * cells + off - 1;
    };
    for (std::uint32_t i = 0; i <= cells; ++i) {
      for (std::uint32_t j = 1; j <= cells; ++j) pages.add_point(pages.points[i] + 1.5 * j / cells * out);
    }
    for (std::uint32_t i = 0; i < cells; ++i) {
      for (std::uint32_t j = 0; j < cells; ++j) {
        pages.add_quad(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j));
      }
    }
  }
  return pages;
}

/// A strip with half a twist: no way to orient its faces alike.
Surface moebius_strip(std::uint32_t cells) {
  const std::uint32_t around = 6 * cells;
  Surface strip;
  for (std::uint32_t i = 0; i < around; ++i) {
    const double turn = static_cast<double>(i) / around;
    for (std::uint32_t j = 0; j <= cells; ++j) {
      const double off = 0.8 * j / cells - 0.4;
      const double r = 1 + off * cosine(turn / 2);
      strip.add_point({r * cosine(turn), r * sine(turn), off * sine(turn / 2)});
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < cells; ++j) {
      const auto vertex = [&](std::uint32_t along, std::uint32_t off) {
        return along < around ? along * (cells + 1) + off : cells - off;
      };
      strip.add_quad(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return strip;
}

/// Two open fans of `blades` faces that meet in one vertex: an hourglass.
Surface hourglass(std::uint32_t blades) {
  Surface fans;
  const std::uint32_t waist = fans.add_point({0, 0, 0});
  for (const double side : {-1.0, 1.0}) {
    const std::uint32_t first = fans.size();
    for (std::uint32_t i = 0; i < blades; ++i) {
      const double turn = side * i / blades;
      fans.add_point({0.7 * cosine(turn), side, 0.7 * sine(turn)});
      fans.faces.push_back({waist, first + (i + 1) % blades, first + i});
    }
  }
  return fans;
}

/// Two closed tetrahedra that touch in one vertex.
Surface touching_tetrahedra() {
  Surface pair;
  const std::uint32_t tip = pair.add_point({0, 0, 0});
  for (const double side : {-1.0, 1.0}) {
    const std::uint32_t a = pair.add_point({side, 0.5, 0.0});
    const std::uint32_t b = pair.add_point({side, -0.4, 0.5 * side});
    const std::uint32_t c = pair.add_point({side, -0.4, -0.5 * side});
    pair.faces.insert(pair.faces.end(), {{tip, b, a}, {tip, c, b}, {tip, a, c}, {a, b, c}});
  }
  return pair;
}

/// Faces that repeat others or themselves, on the vertices that are there.
void add_bad_faces(Surface& soup, Random& random, SoupDefects& defects) {
  const auto good_faces = static_cast<std::uint32_t>(soup.faces.size());
  // Different originals, so that each copy has exactly one.
  const std::uint32_t first = random.below(good_faces);
  for (std::uint32_t copy = 0; copy < 5; ++copy) {
    const auto [a, b, c] = soup.faces[(first + copy * (good_faces / 5)) % good_faces];
    if (copy < 2) soup.faces.push_back({a, b, c});
    if (copy == 2) soup.faces.push_back({b, c, a});
    if (copy > 2) soup.faces.push_back({a, c, b});
  }
  const auto [a, b, c] = soup.faces[random.below(good_faces)];
  soup.faces.insert(soup.faces.end(), {{a, a, b}, {b, c, b}, {c, a, a}, {c, c, c}});
  defects.duplicate_faces = 5;
  defects.repeated_corner_faces = 4;
}

/// Faces without area, on vertices of their own.
void add_zero_area_faces(Surface& soup, SoupDefects& defects) {
  // One triangle with its corners in one place; one along y, which sway() keeps on a line since it moves x
  // and z of points that share them alike.
  const std::uint32_t same = soup.size();
  for (int k = 0; k < 3; ++k) soup.add_point({-3, 2, 1});
  soup.faces.push_back({same, same + 1, same + 2});
  const std::uint32_t line = soup.size();
  for (int k = 0; k < 3; ++k) soup.add_point({3, 0.25 * k, 1});
  soup.faces.push_back({line, line + 1, line + 2});
  defects.zero_area_faces = 2;
}

/// Orders faces, corners and vertices by chance; the shape stays as it is.
void shuffle(Surface& soup, Random& random) {
  const auto permute = [&](auto& items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      std::swap(items[i - 1], items[random.below(static_cast<std::uint32_t>(i))]);
    }
  };
  std::vector<std::uint32_t> order(soup.points.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  permute(order);
  std::vector<Vec3> points(soup.points.size());
  for (std::size_t v = 0; v < order.size(); ++v) points[order[v]] = soup.points[v];
  soup.points = std::move(points);
  permute(soup.faces);
  for (Face& face : soup.faces) {
    for (std::uint32_t& v : face) v = order[v];
    std::rotate(face.begin(), face.begin() + random.below(3), face.end());
  }
}

/// Where a point is at a time; x and z shift by what depends on x and the time alone.
Vec3 sway(const Vec3& p, double seconds) {
  const double lift = 0.25 * sine(0.5 * seconds + 0.15 * p.x);
  const double push = 0.3 * sine(0.7 * seconds + 0.12 * p.x);
  return {p.x + 0.2 * sine(0.4 * seconds), p.y + lift + 0.1 * p.y * push, p.z + push};
}

Surface assemble(std::uint32_t detail, Random& random, SoupDefects& defects) {
  const std::uint32_t cells = std::max(2U, detail / 2);
  Surface soup;
  const auto add = [&](Surface part, const Vec3& centre, double scale) {
    move_to(part, centre, scale);
    soup.append(part);
  };
  add(without_unused(holed_ball(detail)), {0, 0, 0}, 1);
  add(book(cells), {-2.8, 0, 0}, 0.9);
  add(moebius_strip(cells), {2.9, 0, 0}, 1);
  add(hourglass(6), {-1.2, 2.2, 0}, 0.8);
  add(touching_tetrahedra(), {1.4, 2.2, 0}, 0.8);
  defects.non_manifold_edges = cells;
  defects.non_manifold_vertices = 2;
  add_bad_faces(soup, random, defects);
  add_zero_area_faces(soup, defects);
  for (std::uint32_t k = 0; k < kIsolated; ++k) {
    soup.add_point({6 * random.uniform() - 3, 4 * random.uniform() - 2, 2 * random.uniform() - 1});
  }
  defects.isolated_vertices = kIsolated;
  shuffle(soup, random);
  return soup;
}

}  // namespace

SoupSequence make_soup(const SequenceSize& size) {
  SoupSequence soup;
  // Per square of the detail: 6 vertices of the ball less its windows, 0.75 of the book, 1.5 of the strip.
  const auto detail = static_cast<std::uint32_t>(std::max(5.0, std::sqrt(size.vertices / 7.2)));
  Random random(7);
  const Surface surface = assemble(detail, random, soup.defects);
  soup.sequence.mesh = {surface.size(), surface.faces};
  std::vector<Vec3> points(surface.points.size());
  for (std::uint32_t frame = 0; frame < size.frames; ++frame) {
    for (std::size_t v = 0; v < points.size(); ++v) points[v] = sway(surface.points[v], frame / 30.0);
    soup.sequence.frames.push_back(to_frame(points));
  }
  soup.sequence.metadata = {{"name", "soup"}, {"fps", "30"}};
  return soup;
}

}  // namespace tvg::corpus
