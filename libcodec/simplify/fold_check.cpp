#include "simplify/fold_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
      has_sum_(positions.frame_count()),
      normal_(3 * positions.frame_count()) {}

void FoldCheck::begin(std::uint32_t center, const Ring& ring) {
  center_ = center;
  ring_ = &ring;
  const std::size_t frames = positions_.frame_count(), n = ring.size(), faces = ring.faces.size();
  star_.resize(faces * 3 * frames);
  across_.resize(faces * 3 * frames);
  has_across_.assign(faces, 0);
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

bool FoldCheck::allows_face(const RingTriangle& triangle) {
  const std::size_t frames = positions_.frame_count();
  const float* a = positions_.path(ring_->origins[triangle[0]]);
  const float* b = positions_.path(ring_->origins[triangle[1]]);
  const float* c = positions_.path(ring_->origins[triangle[2]]);
  area_normals(a, b, c, frames, normal_.data());
  int bad = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const float length = std::sqrt(dot(normal_.data(), normal_.data(), f, frames));
    const float longest = std::max({squared_distance(a, b, f, frames), squared_distance(b, c, f, frames),
                                    squared_distance(c, a, f, frames)});
    // Where the faces that go have no area there is nothing to turn away from.
    const bool turned = dot(normal_.data(), sum_.data(), f, frames) < least_along_[f] * length;
    const bool thin = length <= kThinnestFace * longest;
    bad |= static_cast<int>(has_sum_[f]) & (static_cast<int>(turned) | static_cast<int>(thin));
  }
  return bad == 0;
}

bool FoldCheck::folds_over(std::size_t place) const {
  const std::size_t frames = positions_.frame_count();
  const float* beyond = across_.data() + place * 3 * frames;
  const float* before = star_.data() + place * 3 * frames;
  static const auto kFolded = static_cast<float>(cosine_of_degrees(kFoldedDegrees));
  int bad = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const float length = std::sqrt(dot(beyond, beyond, f, frames));
    const float now = std::sqrt(dot(normal_.data(), normal_.data(), f, frames));
    const float then = std::sqrt(dot(before, before, f, frames));
    const bool folded = dot(normal_.data(), beyond, f, frames) < kFolded * length * now;
    const bool was_folded = dot(before, beyond, f, frames) < kFolded * length * then;
    bad |= static_cast<int>(folded) & static_cast<int>(!was_folded);
  }
  return bad != 0;
}

bool FoldCheck::allows(std::span<const RingTriangle> triangles) {
  const std::size_t frames = positions_.frame_count(), n = ring_->size();
  for (const RingTriangle& triangle : triangles) {
    if (!allows_face(triangle)) return false;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t place = triangle[c];
      if (triangle[(c + 1) % 3] != (place + 1) % n || place >= ring_->faces.size()) continue;
      if (ring_->across[place] == kNoVertex) continue;
      if (has_across_[place] == 0) {
        has_across_[place] = 1;
        area_normals(positions_.path(ring_->origins[(place + 1) % n]), positions_.path(ring_->origins[place]),
                     positions_.path(ring_->across[place]), frames, across_.data() + place * 3 * frames);
      }
      if (folds_over(place)) return false;
    }
  }
  return true;
}

}  // namespace tvg
