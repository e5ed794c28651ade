#include "base/allocation.hpp"
#include "base/errors.hpp"
#include "base/stream_error.hpp"
#include "geometry/property_fault.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <optional>

#include <tvg/render_view.hpp>

namespace tvg {

namespace {

Status copy_chosen(std::span<const std::uint32_t> chosen, std::span<const float> values,
                   std::uint32_t components, std::span<std::byte> target, std::size_t stride) {
  const std::size_t bytes = components * sizeof(float);
  if (stride < bytes) return invalid_argument("the stride is smaller than a value");
  if (chosen.empty()) return {};
  if (target.size() < bytes || chosen.size() - 1 > (target.size() - bytes) / stride)
    return invalid_argument("the buffer is too small for the render vertices");
  std::byte* to = target.data();
  for (const std::uint32_t value : chosen) {
    if (value == RenderView::kNoValue) {
      std::memset(to, 0, bytes);
    } else {
      std::memcpy(to, values.data() + std::size_t{value} * components, bytes);
    }
    to += stride;
  }
  return {};
}

}  // namespace

/// Makes a view in steps, each of which can run out of memory.
class RenderView::Builder {
 public:
  Builder(const Mesh& mesh, const MeshProperties& properties, RenderView& view)
      : mesh_(mesh), properties_(properties), view_(view) {}

  std::optional<Error> build() {
    if (!describe_attributes() || !gather_corners() || !sort_faces()) return out_of_memory();
    if (!split()) return Error{ErrorCode::kLimitExceeded, "the mesh has too many different corners"};
    return assign_values() && fill_indices() ? std::nullopt : std::optional<Error>(out_of_memory());
  }

 private:
  std::size_t corner_count() const { return 3 * mesh_.faces.size(); }
  std::uint32_t vertex_of(std::uint32_t corner) const { return mesh_.faces[corner / 3][corner % 3]; }
  std::uint32_t value_of(const Attribute& attribute, std::uint32_t corner) const {
    return attribute.domain == AttributeDomain::kPart ? properties_.face_parts[corner / 3]
                                                      : attribute.corners[corner];
  }
  bool has_own_values(std::size_t attribute) const {
    const AttributeDomain domain = properties_.attributes[attribute].domain;
    return domain == AttributeDomain::kCorner ||
           (domain == AttributeDomain::kPart && !properties_.parts.empty());
  }

  bool describe_attributes() {
    const std::vector<Attribute>& given = properties_.attributes;
    if (!try_reserve(view_.attributes_, given.size()) || !try_reserve(split_by_, given.size())) return false;
    for (std::size_t i = 0; i < given.size(); ++i) {
      std::size_t needed = given[i].domain == AttributeDomain::kVertex ? mesh_.vertex_count : 0;
      if (given[i].domain == AttributeDomain::kPart) needed = properties_.parts.size();
      for (const std::uint32_t value : given[i].corners) needed = std::max<std::size_t>(needed, value + 1u);
      view_.attributes_.push_back({given[i].domain, given[i].components, needed, {}});
      if (has_own_values(i)) split_by_.push_back(&given[i]);
    }
    return true;
  }

  /// Sorts the corners by their vertices.
  bool gather_corners() {
    if (!try_resize(corners_, corner_count()) ||
        !try_resize(first_corner_, std::size_t{mesh_.vertex_count} + 2)) {
      return false;
    }
    for (const Face& face : mesh_.faces) {
      for (const std::uint32_t vertex : face) ++first_corner_[std::size_t{vertex} + 2];
    }
    for (std::size_t v = 2; v < first_corner_.size(); ++v) first_corner_[v] += first_corner_[v - 1];
    for (std::uint32_t corner = 0; corner < corner_count(); ++corner)
      corners_[first_corner_[std::size_t{vertex_of(corner)} + 1]++] = corner;
    return true;
  }

  bool sort_faces() {
    const std::size_t parts = properties_.parts.size();
    if (!try_resize(view_.ranges_, std::max<std::size_t>(parts, 1)) ||
        !try_resize(view_.source_faces_, mesh_.faces.size())) {
      return false;
    }
    if (parts == 0) {
      std::iota(view_.source_faces_.begin(), view_.source_faces_.end(), 0u);
      view_.ranges_[0].index_count = corner_count();
      return true;
    }
    for (const std::uint32_t part : properties_.face_parts) view_.ranges_[part].index_count += 3;
    for (std::size_t part = 1; part < parts; ++part)
      view_.ranges_[part].first_index =
          view_.ranges_[part - 1].first_index + view_.ranges_[part - 1].index_count;
    std::vector<std::size_t> next;
    if (!try_resize(next, parts)) return false;
    for (std::size_t part = 0; part < parts; ++part) next[part] = view_.ranges_[part].first_index / 3;
    for (std::uint32_t face = 0; face < mesh_.faces.size(); ++face)
      view_.source_faces_[next[properties_.face_parts[face]]++] = face;
    return true;
  }

  bool alike(std::uint32_t a, std::uint32_t b) const {
    return std::all_of(split_by_.begin(), split_by_.end(), [&](const Attribute* attribute) {
      return value_of(*attribute, a) == value_of(*attribute, b);
    });
  }
  bool before(std::uint32_t a, std::uint32_t b) const {
    for (const Attribute* const attribute : split_by_) {
      const std::uint32_t of_a = value_of(*attribute, a), of_b = value_of(*attribute, b);
      if (of_a != of_b) return of_a < of_b;
    }
    return a < b;
  }
  std::span<std::uint32_t> corners_at(std::size_t vertex) {
    return std::span(corners_).subspan(first_corner_[vertex],
                                       first_corner_[vertex + 1] - first_corner_[vertex]);
  }

  /// Sorts the corners around each vertex by their values (so that no mesh takes longer than sorting does)
  /// and counts the render vertices. False where there are too many.
  bool split() {
    std::uint64_t count = mesh_.vertex_count;
    if (!split_by_.empty()) {
      for (std::size_t v = 0; v < mesh_.vertex_count; ++v) {
        const std::span<std::uint32_t> corners = corners_at(v);
        const auto like_first = [&](std::uint32_t corner) { return alike(corners.front(), corner); };
        if (std::all_of(corners.begin(), corners.end(), like_first)) continue;
        std::sort(corners.begin(), corners.end(),
                  [this](std::uint32_t a, std::uint32_t b) { return before(a, b); });
        for (std::size_t i = 1; i < corners.size(); ++i) count += alike(corners[i - 1], corners[i]) ? 0 : 1;
      }
    }
    render_vertices_ = static_cast<std::size_t>(count);
    return count < kNoValue;
  }

  /// Gives every corner its render vertex, and those their values.
  bool assign_values() {
    if (!try_resize(view_.source_vertices_, render_vertices_) ||
        !try_resize(render_vertex_, corner_count())) {
      return false;
    }
    for (auto& attribute : view_.attributes_) {
      if (attribute.domain == AttributeDomain::kVertex) continue;
      if (!try_resize(attribute.indices, render_vertices_)) return false;
      std::fill(attribute.indices.begin(), attribute.indices.end(), kNoValue);
    }
    std::uint32_t next = mesh_.vertex_count;
    for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
      view_.source_vertices_[v] = v;
      const std::span<const std::uint32_t> corners = corners_at(v);
      std::uint32_t current = v;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const bool is_new = i == 0 || !alike(corners[i - 1], corners[i]);
        if (is_new && i > 0) view_.source_vertices_[current = next++] = v;
        if (is_new) take_values(current, corners[i]);
        render_vertex_[corners[i]] = current;
      }
    }
    return true;
  }

  void take_values(std::uint32_t render_vertex, std::uint32_t corner) {
    for (std::size_t i = 0; i < view_.attributes_.size(); ++i) {
      if (has_own_values(i))
        view_.attributes_[i].indices[render_vertex] = value_of(properties_.attributes[i], corner);
    }
  }

  bool fill_indices() {
    if (!try_reserve(view_.indices_, corner_count())) return false;
    for (const std::uint32_t face : view_.source_faces_) {
      for (std::size_t corner = 0; corner < 3; ++corner)
        view_.indices_.push_back(render_vertex_[3 * std::size_t{face} + corner]);
    }
    return true;
  }

  const Mesh& mesh_;
  const MeshProperties& properties_;
  RenderView& view_;
  std::vector<const Attribute*> split_by_;
  std::vector<std::uint32_t> corners_;        ///< sorted by their vertices
  std::vector<std::size_t> first_corner_;     ///< [vertex], its first place in corners_, and the end
  std::vector<std::uint32_t> render_vertex_;  ///< [corner]
  std::size_t render_vertices_ = 0;
};

Result<RenderView> RenderView::of(const Mesh& mesh, const MeshProperties& properties) {
  if (const char* const fault = property_fault(mesh, properties)) return invalid_input(fault);
  RenderView view;
  view.mesh_vertices_ = mesh.vertex_count;
  if (std::optional<Error> error = Builder(mesh, properties, view).build()) return *std::move(error);
  return view;
}

std::span<const std::uint32_t> RenderView::value_indices(std::size_t attribute) const {
  if (attribute >= attributes_.size()) return {};
  return attributes_[attribute].domain == AttributeDomain::kVertex ? source_vertices_
                                                                   : attributes_[attribute].indices;
}

Status RenderView::copy_vertices(std::span<const float> values, std::span<std::byte> target,
                                 std::size_t stride) const {
  if (values.size() / 3 < mesh_vertices_) return invalid_argument("there are fewer values than vertices");
  return copy_chosen(source_vertices_, values, 3, target, stride);
}

Status RenderView::copy_attribute(std::size_t attribute, std::span<const float> values,
                                  std::span<std::byte> target, std::size_t stride) const {
  if (attribute >= attributes_.size()) return invalid_argument("there is no such attribute");
  const ViewedAttribute& viewed = attributes_[attribute];
  if (values.size() / viewed.components < viewed.values_needed)
    return invalid_argument("there are fewer values than the attribute has");
  return copy_chosen(value_indices(attribute), values, viewed.components, target, stride);
}

}  // namespace tvg
