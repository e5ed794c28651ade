#include "cli/simplified_source.hpp"

#include <algorithm>

namespace tvg::cli {

SimplifiedSource::SimplifiedSource(FrameSource& original, const SimplifiedMesh& simplified, Keep keep)
    : SimplifiedSource(original, simplified.mesh, simplified.vertices, {}) {
  if (keep != Keep::kAttributes) return;
  for (const Attribute& attribute : original.properties().attributes) {
    if (attribute.domain != AttributeDomain::kVertex || attribute.animated) continue;
    Attribute& kept = properties_.attributes.emplace_back(attribute);
    kept.values.clear();
    for (const std::uint32_t vertex : vertices_) {
      const auto first = attribute.values.begin() + std::ptrdiff_t{attribute.components} * vertex;
      kept.values.insert(kept.values.end(), first, first + attribute.components);
    }
  }
}

Result<bool> SimplifiedSource::read_frame(std::span<float> positions) {
  Result<bool> read = original_.read_frame(frame_);
  if (!read || !*read) return read;
  if (places_.empty()) {
    gather(vertices_, frame_, positions);
  } else {
    positions_of(original_.mesh(), places_, frame_, positions);
  }
  return read;
}

void gather(std::span<const std::uint32_t> vertices, std::span<const float> positions,
            std::span<float> result) {
  for (std::size_t v = 0; v < vertices.size(); ++v)
    std::copy_n(positions.begin() + std::ptrdiff_t{3} * vertices[v], 3,
                result.begin() + static_cast<std::ptrdiff_t>(3 * v));
}

}  // namespace tvg::cli
