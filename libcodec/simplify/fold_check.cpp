#include "simplify/fold_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tvg {
namespace {

/// Area normals of a triangle over the frames, [axis][frame]; their length is twice the area.
void area_normals(const float* a, const float* b, const float* c, std::size_t frames, float* normal) {
  const std::size_t y = frames, z = 2 * frames;
  for (std::size_t f = 0; f < frames; ++f) {
    const float ux = b[f] - a[f], uy = b[f + y] - a[f + y], uz = b[f + z] - a[f + z];
    const float vx = c[f] - a[f], vy = c[f + y] - a[f + y], vz = c[f + z] - a[f + z];
    normal[f] = uy * vz - uz * vy;
    normal[f + y] = uz * vx - ux * vz;
    normal[f + z] = ux * vy - uy * vx;
  }
}

float dot(const float* a, const float* b, std::size_t f, std::size_t frames) {
  return a[f] * b[f] + a[f + frames] * b[f + frames] + a[f + 2 * frames] * b[f + 2 * frames];
}

float squared_distance(const float* a, const float* b, std::size_t f, std::size_t frames) {
  const float x = a[f] - b[f], y = a[f + frames] - b[f + frames], z = a[f + 2 * frames] - b[f + 2 * frames];
  return x * x + y * y + z * z;
}

/// The product of the edges from `v` to `a` and to `b`.
float spread(const float* v, const float* a, const float* b, std::size_t f, std::size_t frames) {
  const std::size_t y = f + frames, z = y + frames;
  return (a[f] - v[f]) * (b[f] - v[f]) + (a[y] - v[y]) * (b[y] - v[y]) + (a[z] - v[z]) * (b[z] - v[z]);
}

double cosine_of_degrees(double degrees) {
  return std::cos(degrees * std::numbers::pi / 180);
}

}  // namespace

FoldCheck::FoldCheck(const MovingPositions& positions, double largest_turn)
    : positions_(positions),
      cosine_(cosine_of_degrees(largest_turn)),
      chord_cosine_(cosine_of_degrees(largest_turn / 2)),
      sum_(3 * positions.frame_count()),
      least_along_(positions.frame_count()),
      has_sum_(positions.frame_count()) {}

void FoldCheck::begin(std::uint32_t center, const Ring& ring) {
  center_ = center;
  ring_ = &ring;
  const std::size_t frames = positions_.frame_count(), n = ring.size(), faces = ring.faces.size();
  star_.resize(faces * 3 * frames);
  across_.resize(faces * 3 * frames);
  std::fill(sum_.begin(), sum_.end(), 0.0f);
  angles_.assign(faces, 0.0);
  radii_.assign(n, 0.0);
  const float* v = positions_.path(center);
  for (std::size_t i = 0; i < n; ++i) {
    const float* a = positions_.path(ring.origins[i]);
    for (std::size_t f = 0; f < frames; ++f) radii_[i] += std::sqrt(squared_distance(a, v, f, frames));
    radii_[i] /= static_cast<double>(frames);
    if (i >= faces) break;
    const float* b = positions_.path(ring.origins[(i + 1) % n]);
    float* normal = star_.data() + i * 3 * frames;
    area_normals(v, a, b, frames, normal);
    for (std::size_t k = 0; k < 3 * frames; ++k) sum_[k] += normal[k];
    for (std::size_t f = 0; f < frames; ++f) {
      angles_[i] += std::atan2(std::sqrt(dot(normal, normal, f, frames)), spread(v, a, b, f, frames));
    }
    angles_[i] /= static_cast<double>(frames);
  }
  judge_star();
  count_star_folds();
}

void FoldCheck::judge_star() {
  const std::size_t frames = positions_.frame_count();
  const auto cosine = static_cast<float>(cosine_);
  for (std::size_t f = 0; f < frames; ++f) {
    const float whole = std::sqrt(dot(sum_.data(), sum_.data(), f, frames));
    has_sum_[f] = whole > 0 ? 1 : 0;
    least_along_[f] = cosine * whole;
  }
  for (std::size_t i = 0; i < ring_->faces.size(); ++i) {
    const float* normal = star_.data() + i * 3 * frames;
    for (std::size_t f = 0; f < frames; ++f) {
      const float length = std::sqrt(dot(normal, normal, f, frames));
      const float along = length > 0 ? dot(normal, sum_.data(), f, frames) / length : least_along_[f];
      least_along_[f] = std::min(least_along_[f], along);
    }
  }
}

bool FoldCheck::allows_chord() const {
  const std::size_t frames = positions_.frame_count();
  const float* v = positions_.path(center_);
  const float* a = positions_.path(ring_->origins.front());
  const float* b = positions_.path(ring_->origins.back());
  const auto smallest = static_cast<float>(chord_cosine_);
  for (std::size_t f = 0; f < frames; ++f) {
    const float chord = squared_distance(a, b, f, frames), first = squared_distance(a, v, f, frames),
                last = squared_distance(v, b, f, frames);
    // The law of cosines gives the products of the chord with the two edges.
    const float along_first = (chord + first - last) / 2, along_last = (chord + last - first) / 2;
    if (along_first < smallest * std::sqrt(chord) * std::sqrt(first)) return false;
    if (along_last < smallest * std::sqrt(chord) * std::sqrt(last)) return false;
  }
  return true;
}

bool FoldCheck::allows_face(const RingTriangle& triangle, float* normal) const {
  const std::size_t frames = positions_.frame_count();
  const float* a = positions_.path(ring_->origins[triangle[0]]);
  const float* b = positions_.path(ring_->origins[triangle[1]]);
  const float* c = positions_.path(ring_->origins[triangle[2]]);
  area_normals(a, b, c, frames, normal);
  int bad = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const float length = std::sqrt(dot(normal, normal, f, frames));
    const float longest = std::max({squared_distance(a, b, f, frames), squared_distance(b, c, f, frames),
                                    squared_distance(c, a, f, frames)});
    // Where the faces that go have no area there is nothing to turn away from.
    const bool turned = dot(normal, sum_.data(), f, frames) < least_along_[f] * length;
    const bool thin = length <= kThinnestFace * longest;
    bad |= static_cast<int>(has_sum_[f]) & (static_cast<int>(turned) | static_cast<int>(thin));
  }
  return bad == 0;
}

void FoldCheck::Folds::clear(std::size_t frames) {
  creased.assign(frames, 0);
  folded.assign(frames, 0);
}

void FoldCheck::count_folds(const float* a, const float* b, double margin, Folds& folds) const {
  const std::size_t frames = positions_.frame_count();
  const auto creased = static_cast<float>(cosine_of_degrees(kCreasedDegrees + margin));
  const auto folded = static_cast<float>(cosine_of_degrees(kFoldedDegrees + margin));
  for (std::size_t f = 0; f < frames; ++f) {
    const float lengths = std::sqrt(dot(a, a, f, frames)) * std::sqrt(dot(b, b, f, frames));
    const float along = dot(a, b, f, frames);
    folds.creased[f] += along < creased * lengths ? 1 : 0;
    folds.folded[f] += along < folded * lengths ? 1 : 0;
  }
}

void FoldCheck::count_star_folds() {
  const std::size_t frames = positions_.frame_count(), n = ring_->size(), faces = ring_->faces.size();
  star_folds_.clear(frames);
  for (std::size_t i = 0; i < faces; ++i) {
    const float* normal = star_.data() + i * 3 * frames;
    if (ring_->closed || i + 1 < faces)
      count_folds(normal, star_.data() + (i + 1) % faces * 3 * frames, kMargin, star_folds_);
    if (ring_->across[i] == kNoVertex) continue;
    float* beyond = across_.data() + i * 3 * frames;
    area_normals(positions_.path(ring_->origins[(i + 1) % n]), positions_.path(ring_->origins[i]),
                 positions_.path(ring_->across[i]), frames, beyond);
    count_folds(normal, beyond, kMargin, star_folds_);
  }
}

bool FoldCheck::adds_folds(std::span<const RingTriangle> triangles) {
  const std::size_t frames = positions_.frame_count(), n = ring_->size();
  folds_.clear(frames);
  const auto side = [&](std::size_t t, std::size_t c) {
    return std::pair(triangles[t][c], triangles[t][(c + 1) % 3]);
  };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const float* normal = fresh_.data() + t * 3 * frames;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [from, to] = side(t, c);
      if (to == (from + 1) % n && from < ring_->faces.size()) {
        if (ring_->across[from] != kNoVertex)
          count_folds(normal, across_.data() + from * 3 * frames, -kMargin, folds_);
        continue;
      }
      for (std::size_t other = t + 1; other < triangles.size(); ++other) {
        for (std::size_t d = 0; d < 3; ++d) {
          if (side(other, d) == std::pair(to, from))
            count_folds(normal, fresh_.data() + other * 3 * frames, -kMargin, folds_);
        }
      }
    }
  }
  for (std::size_t f = 0; f < frames; ++f) {
    if (folds_.folded[f] > star_folds_.folded[f]) return true;
    if (!creases_allowed_ && folds_.creased[f] > star_folds_.creased[f]) return true;
  }
  return false;
}

bool FoldCheck::allows(std::span<const RingTriangle> triangles) {
  const std::size_t frames = positions_.frame_count();
  fresh_.resize(triangles.size() * 3 * frames);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!allows_face(triangles[t], fresh_.data() + t * 3 * frames)) return false;
  }
  return !adds_folds(triangles);
}

}  // namespace tvg
