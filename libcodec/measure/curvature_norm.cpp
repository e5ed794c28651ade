#include "measure/curvature_norm.hpp"

#include "measure/frames_diagonal.hpp"
#include "measure/lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tvg {

namespace {

/// Whether the faces around each vertex form one closed fan, [vertex]; faces that name a vertex twice are
/// left out.
std::vector<std::uint8_t> closed_fans(const Mesh& mesh, const OneRings& rings) {
  std::vector<std::uint8_t> closed(mesh.vertex_count, 0);
  std::vector<std::array<std::uint32_t, 2>> spokes;  // the other two corners of each face, in its sense
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    spokes.clear();
    for (const std::uint32_t f : rings.faces_at(v)) {
      const Face& face = mesh.faces[f];
      if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
      const std::size_t k = face[1] == v ? 1 : face[2] == v ? 2 : 0;
      spokes.push_back({face[(k + 1) % 3], face[(k + 2) % 3]});
    }
    if (spokes.size() < 3) continue;
    // Walk from face to face, those met before `met`: one fan is closed when the walk meets every face once
    // and ends at its start.
    const std::uint32_t start = spokes[0][0];
    std::uint32_t at = start;
    std::size_t met = 0;
    do {
      std::size_t next = met, candidates = 0;
      for (std::size_t k = met; k < spokes.size(); ++k) {
        if (spokes[k][0] == at) next = k, ++candidates;
      }
      if (candidates != 1) break;
      std::swap(spokes[met], spokes[next]);
      at = spokes[met++][1];
    } while (at != start);
    closed[v] = met == spokes.size() && at == start ? 1 : 0;
  }
  return closed;
}

/// What the faces add up to at a vertex.
struct Ring {
  Point laplace = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};  ///< sum of (cot a + cot b) (x_i - x_j)
  Lanes area = Lanes::Zero();                                     ///< mixed Voronoi area
  Lanes angle = Lanes::Zero();                                    ///< sum of the angles at the vertex
};

/// The curvature norm, of kLanes frames at a time. What only depends on the connectivity, and memory, are
/// kept for the frames that follow.
class CurvatureNorm {
 public:
  CurvatureNorm(const Mesh& mesh, const OneRings& rings)
      : closed_(closed_fans(mesh, rings)), positions_(mesh.vertex_count), rings_(mesh.vertex_count) {
    for (const Face& face : mesh.faces) {
      if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
      faces_.push_back(face);
      const bool open = closed_[face[0]] == 0 || closed_[face[1]] == 0 || closed_[face[2]] == 0;
      open_.push_back(open ? 1 : 0);
      if (open) normals_.resize(mesh.vertex_count);
    }
  }

  /// The norm times `scale`, [frame][vertex], of one to kLanes frames.
  void evaluate(std::span<const std::span<const float>> frames, double scale,
                std::span<std::vector<double>> norms) {
    set_positions(frames);
    std::fill(rings_.begin(), rings_.end(), Ring());
    std::fill(normals_.begin(), normals_.end(), Ring().laplace);
    for (std::size_t f = 0; f < faces_.size(); ++f) add_face(faces_[f], open_[f] != 0);
    for (std::vector<double>& norm : norms) norm.resize(rings_.size());
    for (std::size_t v = 0; v < rings_.size(); ++v) {
      const Lanes norm = scale * norm_at(v);
      for (std::size_t lane = 0; lane < norms.size(); ++lane) {
        norms[lane][v] = norm[static_cast<Eigen::Index>(lane)];
      }
    }
  }

 private:
  /// Lanes without a frame of their own repeat the last.
  void set_positions(std::span<const std::span<const float>> frames) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::span<const float> frame = frames[std::min(lane, frames.size() - 1)];
      for (std::size_t v = 0; v < positions_.size(); ++v) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          positions_[v][axis][static_cast<Eigen::Index>(lane)] = frame[3 * v + axis];
        }
      }
    }
  }

  void add_face(const Face& face, bool open) {
    static constexpr Same kNone(0), kEighth(1.0 / 8), kOne(1), kPi(std::numbers::pi);
    const Point &a = positions_[face[0]], &b = positions_[face[1]], &c = positions_[face[2]];
    const std::array<Point, 3> edge = {minus(c, b), minus(a, c), minus(b, a)};  // across from each corner
    const Point normal = cross(edge[1], edge[2]);
    Lanes twice_area = dot(normal, normal).sqrt();
    // Around the face one edge comes to a corner and one leaves it: these are minus the cotangents, times 2A.
    std::array<Lanes, 3> dots = {dot(edge[1], edge[2]), dot(edge[2], edge[0]), dot(edge[0], edge[1])};
    Lanes usable = Lanes::Ones();
    if (!(twice_area > 0).all()) {  // rare: then nothing but `normal`, which is 0, may remain of that lane
      usable = (twice_area > 0).select(usable, 0.0);
      for (Lanes& product : dots) product = (twice_area > 0).select(product, 0.0);
      twice_area = (twice_area > 0).select(twice_area, 1.0);
    }
    const Lanes inverse = usable / twice_area, eighth = usable * twice_area * kEighth();
    std::array<Lanes, 3> signs, obtuse;
    std::array<Point, 3> pull;  // -cot a (x_j - x_k), a across from the edge from k to j
    for (std::size_t k = 0; k < 3; ++k) {
      signs[k] = sign_of(dots[k]);
      obtuse[k] = signs[k].max(kNone());
      pull[k] = times(dots[k] * inverse, edge[k]);
    }
    const Lanes angle_a = usable * (kPi() - angle_to(dots[0], signs[0], twice_area));
    const Lanes angle_b = usable * (kPi() - angle_to(dots[1], signs[1], twice_area));
    const std::array<Lanes, 3> angle = {angle_a, angle_b, usable * kPi() - angle_a - angle_b};
    // The Voronoi area (cot b |edge b|^2 + cot c |edge c|^2) / 8 at corner a is A / 4 + cot b cot c A / 4,
    // for |edge b|^2 = 2A (cot a + cot c) and cot a cot b + cot b cot c + cot c cot a = 1. In an obtuse
    // triangle, A / 2 at the obtuse corner and A / 4 at the others take its place.
    const Lanes acute = (kOne() - (obtuse[0] + obtuse[1] + obtuse[2])) * (inverse * kEighth());
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      Ring& ring = rings_[face[k]];
      add(ring.laplace, minus(pull[last], pull[next]));
      ring.area += eighth + eighth * obtuse[k] + acute * dots[next] * dots[last];
      ring.angle += angle[k];
      if (open) add(normals_[face[k]], normal);
    }
  }

  Lanes norm_at(std::size_t v) const {
    const Ring& ring = rings_[v];
    if (!(ring.area > 0).any()) return Lanes::Zero();
    Lanes norm;
    if (closed_[v] != 0) {
      const Lanes inverse = 1 / ring.area;
      const Lanes squared_mean = dot(ring.laplace, ring.laplace) * (inverse * inverse / 16);
      const Lanes gauss = ((2 * std::numbers::pi - ring.angle) * inverse).min(squared_mean);
      norm = (4 * squared_mean - 2 * gauss).sqrt();
    } else {
      const Lanes length = dot(normals_[v], normals_[v]).sqrt();
      norm = dot(ring.laplace, normals_[v]).abs() / (2 * ring.area * length);
      norm = (length > 0).select(norm, 0.0);
    }
    return (ring.area > 0).all() ? norm : Lanes((ring.area > 0).select(norm, 0.0));
  }

  std::vector<std::uint8_t> closed_;  ///< [vertex] whether its faces form one closed fan
  std::vector<Face> faces_;           ///< those without a vertex twice
  std::vector<std::uint8_t> open_;    ///< [face] whether some corner is not closed
  std::vector<Point> positions_;      ///< [vertex]
  std::vector<Ring> rings_;           ///< [vertex]
  std::vector<Point> normals_;        ///< [vertex] sums of area normals, where `open_`; else empty
};

}  // namespace

std::vector<double> vertex_curvature_norm(const Mesh& mesh, const OneRings& rings,
                                          std::span<const float> positions) {
  std::vector<double> norm;
  CurvatureNorm(mesh, rings).evaluate(std::span(&positions, 1), 1, std::span(&norm, 1));
  return norm;
}

std::vector<double> curvature_norm_criterion(const CriterionInput& input) {
  CurvatureNorm curvature_norm(input.mesh, OneRings(input.mesh));
  const double diagonal = frames_diagonal(input.frames);
  const std::vector<std::span<const float>> frames(input.frames.begin(), input.frames.end());
  std::vector<std::vector<double>> norms(frames.size());
  for (std::size_t first = 0; first < frames.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, frames.size() - first);
    curvature_norm.evaluate(std::span(frames).subspan(first, count), diagonal,
                            std::span(norms).subspan(first, count));
  }
  return change_and_mean(input, norms);
}

}  // namespace tvg
