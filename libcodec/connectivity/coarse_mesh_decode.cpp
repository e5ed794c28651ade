#include "base/allocation.hpp"
#include "connectivity/coarse_mesh.hpp"
#include "connectivity/vertex_order.hpp"

#include <algorithm>
#include <utility>

#include <tvg/levels.hpp>

namespace tvg {

namespace {

constexpr const char* kSection = "§5.6";

}  // namespace

// format-spec §5.6
Fault read_coarse_layouts(Bytes section, std::uint32_t face_count, CoarseLayouts& layouts) {
  ByteReader reader(section);
  const std::uint64_t count = reader.varint();
  if (!reader.ok() || count == 0 || count > kMaxCoarseMeshes)
    return {kSection, "the number of coarse meshes is out of range"};
  layouts.count = static_cast<std::size_t>(count);
  std::uint64_t finer = kMaxVertexLevels;
  for (CoarseLayout& mesh : std::span(layouts.meshes).first(layouts.count)) {
    const std::uint64_t levels = reader.varint(), vertices = reader.varint(), faces = reader.varint();
    mesh.connectivity = reader.bytes(reader.varint());
    mesh.order = reader.bytes(reader.varint());
    if (!reader.ok()) return {kSection, "the section of coarse meshes is too short"};
    if (levels == 0 || levels >= finer) return {kSection, "the levels of coarse meshes do not descend"};
    if (vertices > kMaxVertexCount || faces > face_count)
      return {kSection, "a coarse mesh has more faces than the mesh"};
    finer = levels;
    mesh.levels = static_cast<std::uint32_t>(levels);
    mesh.vertex_count = static_cast<std::uint32_t>(vertices);
    mesh.face_count = static_cast<std::uint32_t>(faces);
  }
  if (!reader.finished()) return {kSection, "the coarse meshes do not fill their section exactly"};
  return {};
}

Fault check_coarse_layouts(const CoarseLayouts& layouts, std::span<const std::uint8_t> levels) {
  std::array<std::uint32_t, kMaxVertexLevels> sizes{};
  for (const std::uint8_t level : levels) ++sizes[level];
  const CoarseLayout& finest = layouts.meshes.front();
  if (finest.levels >= sizes.size() || sizes[finest.levels] == 0)
    return {kSection, "a coarse mesh has all levels that there are"};
  for (const CoarseLayout& mesh : std::span(layouts.meshes).first(layouts.count)) {
    std::uint32_t vertices = 0;
    for (std::uint32_t level = 0; level < mesh.levels; ++level) vertices += sizes[level];
    if (vertices != mesh.vertex_count)
      return {kSection, "a coarse mesh has other vertices than those of its levels"};
  }
  return {};
}

namespace {

/// The vertices of levels below `below`; `place` becomes, for each of them in order of traversal, its place
/// in the cut. False without memory.
bool select_vertices(std::uint32_t below, std::span<const std::uint8_t> levels,
                     std::span<const std::uint32_t> order, std::size_t count, CoarseCut& cut,
                     std::vector<std::uint32_t>& place) {
  std::vector<std::uint64_t> by_number;  // number in the whole mesh, and traversal index
  if (!try_reserve(cut.vertices, count) || !try_reserve(cut.numbers, count) || !try_resize(place, count) ||
      !try_reserve(by_number, count))
    return false;
  for (std::uint32_t t = 0; t < levels.size(); ++t) {
    if (levels[t] < below) by_number.push_back(std::uint64_t{order[t]} << 32 | t);
  }
  std::sort(by_number.begin(), by_number.end());
  for (const std::uint64_t entry : by_number) {
    cut.numbers.push_back(static_cast<std::uint32_t>(entry >> 32));
    cut.vertices.push_back(static_cast<std::uint32_t>(entry));
  }
  for (std::size_t i = 0; i < count; ++i) by_number[i] = std::uint64_t{cut.vertices[i]} << 32 | i;
  std::sort(by_number.begin(), by_number.end());
  for (std::size_t rank = 0; rank < count; ++rank) place[rank] = static_cast<std::uint32_t>(by_number[rank]);
  return true;
}

}  // namespace

// format-spec §5.6
Result<CoarseCut> decode_coarse_mesh(const CoarseLayout& layout, std::span<const std::uint8_t> levels,
                                     std::span<const std::uint32_t> order) {
  constexpr std::size_t kPerVertex = 56;
  if (!can_allocate_connectivity(layout.connectivity, layout.vertex_count, layout.face_count, kPerVertex))
    return out_of_memory();
  Result<Connectivity> connectivity =
      decode_connectivity(layout.connectivity, layout.vertex_count, layout.face_count);
  if (!connectivity) return connectivity.error();
  const Result<std::vector<std::uint32_t>> ranks = decode_order(layout.order, connectivity->gates);
  if (!ranks) return ranks.error();
  CoarseCut cut;
  std::vector<std::uint32_t> place;
  if (!select_vertices(layout.levels, levels, order, layout.vertex_count, cut, place)) return out_of_memory();
  cut.mesh = {layout.vertex_count, std::move(connectivity->faces)};
  for (Face& face : cut.mesh.faces) {
    for (std::uint32_t& corner : face) corner = place[(*ranks)[corner]];
  }
  return cut;
}

}  // namespace tvg
