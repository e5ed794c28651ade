#include "player/view/surface.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <tvg/normals.hpp>

namespace tvg::player {

namespace {

constexpr std::size_t kNone = SIZE_MAX;

/// Which attribute is the nth of its kind that does not change with frames, or that does.
std::size_t attribute_of(const MeshProperties& properties, AttributeKind kind, std::size_t nth = 0,
                         bool animated = false) {
  for (std::size_t i = 0; i < properties.attributes.size(); ++i) {
    const Attribute& attribute = properties.attributes[i];
    if (attribute.kind == kind && attribute.animated == animated && nth-- == 0) return i;
  }
  return kNone;
}

/// Values ([value][component]) for each render vertex, by the value it has, so many numbers of each; where
/// there are fewer, numbers stay as they are.
void spread_values(std::span<const std::uint32_t> indices, std::span<const float> values,
                   std::size_t components, std::size_t wanted, std::span<float> target) {
  const std::size_t numbers = std::min(components, wanted);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::size_t first = components * std::size_t{indices[i]};
    if (indices[i] == RenderView::kNoValue || first + components > values.size()) continue;
    for (std::size_t c = 0; c < numbers; ++c) target[wanted * i + c] = values[first + c];
  }
}

/// The values of an attribute for each render vertex, so many numbers of each; `otherwise` where there are
/// fewer.
std::vector<float> values_of(const RenderView& view, const MeshProperties& properties, std::size_t which,
                             std::size_t components, float otherwise) {
  if (which == kNone) return {};
  const Attribute& attribute = properties.attributes[which];
  std::vector<float> values(components * view.vertex_count(), otherwise);
  spread_values(view.value_indices(which), attribute.values, attribute.components, components, values);
  return values;
}

/// Render vertices that are the same vertex and have the same normal share one.
void make_groups(Surface& surface, const MeshProperties& properties) {
  const RenderView& view = surface.view;
  const std::size_t normals = attribute_of(properties, AttributeKind::kNormal);
  const std::span<const std::uint32_t> values =
      normals == kNone ? std::span<const std::uint32_t>() : view.value_indices(normals);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  surface.groups.resize(view.vertex_count());
  for (std::size_t i = 0; i < surface.groups.size(); ++i) {
    const std::pair key(view.source_vertices()[i], values.empty() ? 0 : values[i]);
    surface.groups[i] = known.emplace(key, static_cast<std::uint32_t>(known.size())).first->second;
  }
  surface.group_count = known.size();
  surface.group_faces.resize(view.indices().size() / 3);
  for (std::size_t i = 0; i < view.indices().size(); ++i)
    surface.group_faces[i / 3][i % 3] = surface.groups[view.indices()[i]];
}

/// The materials of the parts, and neighbours of the same together.
void make_runs(Surface& surface, const MeshProperties& properties, const ShownMaterials& materials) {
  const std::span<const RenderView::Range> ranges = surface.view.ranges();
  std::string last;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const std::string name = i < properties.parts.size() ? properties.parts[i].material : std::string();
    if (ranges[i].index_count == 0) continue;
    if (!surface.runs.empty() && name == last) {
      surface.runs.back().faces.index_count += ranges[i].index_count;
      continue;
    }
    const ShownMaterial* const material = materials.find(name);
    surface.runs.push_back(
        {ranges[i], material != nullptr ? *material : ShownMaterial(), material == nullptr});
    last = name;
  }
}

}  // namespace

std::shared_ptr<const Surface> make_surface(const Mesh& mesh, const MeshProperties& properties,
                                            const ShownMaterials& materials) {
  const auto has_material = [&](const Part& part) { return materials.find(part.material) != nullptr; };
  const bool has_materials = std::ranges::any_of(properties.parts, has_material);
  const std::size_t colours = attribute_of(properties, AttributeKind::kColour);
  const std::size_t frame_colours =
      colours == kNone ? attribute_of(properties, AttributeKind::kColour, 0, true) : kNone;
  const bool has_colours = colours != kNone || frame_colours != kNone;
  const bool has_edges = attribute_of(properties, AttributeKind::kNormal) != kNone;
  const bool has_looks = has_materials || has_edges;
  if (!has_colours && (mesh.faces.empty() || !has_looks)) return nullptr;
  Result<RenderView> view = RenderView::of(mesh, properties);
  if (!view) return nullptr;
  auto surface = std::make_shared<Surface>();
  surface->view = *std::move(view);
  make_runs(*surface, properties, materials);
  const auto textured = std::ranges::find_if(
      surface->runs, [](const Surface::Run& run) { return run.material.texture != nullptr; });
  if (textured != surface->runs.end()) {
    const std::size_t texcoord =
        attribute_of(properties, AttributeKind::kTexcoord, textured->material.texcoord);
    surface->texcoords = values_of(surface->view, properties, texcoord, 2, 0);
    for (std::size_t i = 1; i < surface->texcoords.size(); i += 2)
      surface->texcoords[i] = 1 - surface->texcoords[i];
  }
  surface->colours = values_of(surface->view, properties, colours, 4, 1);
  if (frame_colours != kNone)
    surface->frame_colours = {frame_colours, properties.attributes[frame_colours].components};
  make_groups(*surface, properties);
  return surface;
}

void SurfaceFrame::set(const Surface& surface, std::span<const float> positions,
                       std::span<const float> colours) {
  const std::span<const std::uint32_t> sources = surface.view.source_vertices();
  positions_.resize(3 * sources.size());
  normals_.resize(3 * sources.size());
  group_positions_.resize(3 * surface.group_count);
  group_normals_.resize(3 * surface.group_count);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::span<const float> at = positions.subspan(3 * std::size_t{sources[i]}, 3);
    std::ranges::copy(at, positions_.begin() + static_cast<std::ptrdiff_t>(3 * i));
    std::ranges::copy(at, group_positions_.begin() + 3 * static_cast<std::ptrdiff_t>(surface.groups[i]));
  }
  vertex_normals(surface.group_faces, group_positions_, group_normals_);
  for (std::size_t i = 0; i < sources.size(); ++i)
    std::copy_n(group_normals_.begin() + 3 * static_cast<std::ptrdiff_t>(surface.groups[i]), 3,
                normals_.begin() + static_cast<std::ptrdiff_t>(3 * i));
  colours_.assign(colours.empty() || !surface.frame_colours ? 0 : 4 * sources.size(), 1);
  if (colours_.empty()) return;
  spread_values(surface.view.value_indices(surface.frame_colours->attribute), colours,
                surface.frame_colours->components, 4, colours_);
}

}  // namespace tvg::player
