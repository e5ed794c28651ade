#include "decoder/exporters/gltf_stretch.hpp"

#include "decoder/exporters/bytes.hpp"
#include "decoder/exporters/gltf_part_extras.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

namespace tvg::cli {

using nlohmann::json;

namespace {

constexpr std::size_t kTriple = 3 * sizeof(float);

/// Three 16-bit integers, and padding: elements begin at multiples of four bytes.
constexpr std::size_t kShortStride = 8;

void store_short(std::uint8_t* bytes, std::int32_t value) {
  bytes[0] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value));
  bytes[1] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> 8);
}

}  // namespace

GltfStretch::GltfStretch(Mesh mesh, MeshProperties properties, std::uint64_t first_frame,
                         std::unique_ptr<AtomicFile> scratch)
    : mesh_(std::move(mesh)),
      properties_(std::move(properties)),
      first_frame_(first_frame),
      scratch_(std::move(scratch)) {
  Result<RenderView> view = RenderView::of(mesh_, properties_);
  if (!view) throw ToolError(ExitStatus::kOther, "glTF: " + view.error().message);
  view_ = std::move(*view);
}

GltfStretch::~GltfStretch() = default;

void GltfStretch::add_frame(std::span<const float> positions, AnimatedValues animated, GltfBuffer& buffer) {
  const MeshFrame frame{mesh_, properties_, positions, animated};
  const bool is_first = frames_++ == 0;
  if (mesh_.vertex_count == 0) return;
  if (is_first) {
    first_.assign(positions.begin(), positions.end());
    attributes_ = write_gltf_attributes(view_, frame, buffer);
    if (!scratch_) write_base(buffer);
  } else {
    write_target(frame, buffer);
  }
  if (scratch_) keep_for_later(positions);
}

std::span<const float> GltfStretch::spread_positions(std::span<const float> positions) {
  spread_.resize(3 * view_.vertex_count());
  const Status status = view_.copy_vertices(positions, std::as_writable_bytes(std::span(spread_)));
  if (!status.ok()) throw ToolError(ExitStatus::kOther, "glTF: " + status.error().message);
  return spread_;
}

void GltfStretch::write_base(GltfBuffer& buffer) {
  spread_positions(first_);
  base_ = spread_;
  const GltfBounds bounds = bounds_of(base_, 3);
  buffer.begin_view(GltfTarget::kVertices);
  attributes_.accessors["POSITION"] = buffer.add_accessor(
      {GltfComponent::kFloat, "VEC3", view_.vertex_count(), false, bounds.least, bounds.most});
  buffer.write(std::span<const float>(base_));
  buffer.end_view();
}

void GltfStretch::write_target(const MeshFrame& frame, GltfBuffer& buffer) {
  const bool normals_change =
      !attributes_.normals.empty() && frame.properties.attributes[*attributes_.normal].animated;
  json& target = targets_.emplace_back(json::object());
  if (scratch_ && !normals_change) return;
  if (!buffer.view_is_open()) buffer.begin_view(GltfTarget::kVertices, kTriple);
  if (!scratch_) target["POSITION"] = write_differences(spread_positions(frame.positions), base_, buffer);
  if (!normals_change) return;
  const std::span<const float> values = values_of(frame, *attributes_.normal);
  const std::vector<float> normals =
      values.empty() ? attributes_.normals : gltf_normals(view_, *attributes_.normal, values);
  target["NORMAL"] = write_differences(normals, attributes_.normals, buffer);
}

std::size_t GltfStretch::write_differences(std::span<const float> values, std::span<const float> base,
                                           GltfBuffer& buffer) {
  difference_.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) difference_[i] = values[i] - base[i];
  const GltfBounds bounds = bounds_of(difference_, 3);
  const std::size_t accessor = buffer.add_accessor(
      {GltfComponent::kFloat, "VEC3", view_.vertex_count(), false, bounds.least, bounds.most});
  buffer.write(std::span<const float>(difference_));
  return accessor;
}

void GltfStretch::keep_for_later(std::span<const float> positions) {
  if (frames_ == 1) {
    for (std::size_t axis = 0; axis < 3; ++axis) least_[axis] = most_[axis] = positions[axis];
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double value = positions[i];
    least_[i % 3] = std::min(least_[i % 3], value);
    most_[i % 3] = std::max(most_[i % 3], value);
    farthest_ = std::max(farthest_, std::abs(value - double{first_[i]}));
  }
  scratch_->write(positions.data(), positions.size_bytes());
}

/// Positions on a lattice of 16 bits over all frames: the first frame as unsigned, differences from it as
/// signed numbers, so that the lattice is coarser where a vertex goes farther than half its extent.
void GltfStretch::write_quantized(GltfPlacedMesh& placed, GltfBuffer& buffer) {
  scratch_->flush();
  double extent = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, most_[axis] - least_[axis]);
  // Both ends of a difference are rounded: it may be one step longer than it is.
  const double step = std::max(extent / 65535, farthest_ / 32766);
  placed.scale = step > 0 ? step : 1;
  placed.translation = least_;
  std::vector<std::int32_t> first(first_.size()), lattice(first_.size());
  std::vector<std::uint8_t> bytes(kShortStride * view_.vertex_count());
  std::ifstream frames(scratch_->temporary_path(), std::ios::binary);
  std::vector<float> positions(first_.size());
  buffer.begin_view(GltfTarget::kVertices, kShortStride);
  for (std::uint64_t frame = 0; frame < frames_; ++frame) {
    frames.read(reinterpret_cast<char*>(positions.data()),
                static_cast<std::streamsize>(positions.size() * sizeof(float)));
    if (!frames) throw ToolError(ExitStatus::kIo, scratch_->path() + " cannot be read back");
    for (std::size_t i = 0; i < positions.size(); ++i) {
      lattice[i] =
          static_cast<std::int32_t>(std::lround((double{positions[i]} - least_[i % 3]) / placed.scale)) -
          first[i];
    }
    std::vector<double> low(3, 0), high(3, 0);
    for (std::size_t i = 0; i < view_.vertex_count(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int32_t value = lattice[3 * std::size_t{view_.source_vertices()[i]} + axis];
        store_short(&bytes[kShortStride * i + 2 * axis], value);
        low[axis] = i == 0 ? value : std::min<double>(low[axis], value);
        high[axis] = i == 0 ? value : std::max<double>(high[axis], value);
      }
    }
    const std::size_t accessor =
        buffer.add_accessor({frame == 0 ? GltfComponent::kUnsignedShort : GltfComponent::kShort, "VEC3",
                             view_.vertex_count(), false, low, high});
    buffer.write(std::span<const std::uint8_t>(bytes));
    if (frame == 0) {
      attributes_.accessors["POSITION"] = accessor;
      first = lattice;
    } else {
      targets_[frame - 1]["POSITION"] = accessor;
    }
  }
  buffer.end_view();
}

/// One for each part that has faces, all of the same vertices.
json GltfStretch::primitives(GltfBuffer& buffer, GltfMaterials& materials) const {
  json list = json::array();
  json common = {{"attributes", attributes_.accessors}};
  if (!targets_.empty()) common["targets"] = targets_;
  if (mesh_.faces.empty()) {
    common["mode"] = 0;  // points
    return json::array({common});
  }
  buffer.begin_view(GltfTarget::kIndices);
  for (std::size_t part = 0; part < view_.ranges().size(); ++part) {
    const RenderView::Range& range = view_.ranges()[part];
    if (range.index_count == 0) continue;
    json primitive = common;
    primitive["indices"] =
        buffer.add_accessor({GltfComponent::kUnsignedInt, "SCALAR", range.index_count, false, {}, {}});
    buffer.write(view_.indices().subspan(range.first_index, range.index_count));
    if (part < properties_.parts.size() && !properties_.parts[part].material.empty())
      primitive["material"] = materials.number_of(properties_.parts[part].material);
    json extras = gltf_part_extras(
        properties_, part, view_.source_faces().subspan(range.first_index / 3, range.index_count / 3));
    if (!attributes_.names.empty()) extras["names"] = attributes_.names;
    if (!extras.is_null()) primitive["extras"] = std::move(extras);
    list.push_back(std::move(primitive));
  }
  buffer.end_view();
  return list;
}

GltfPlacedMesh GltfStretch::finish(json& document, GltfBuffer& buffer, GltfMaterials& materials) {
  GltfPlacedMesh placed;
  placed.first_frame = first_frame_;
  placed.frames = frames_;
  if (buffer.view_is_open()) buffer.end_view();
  if (mesh_.vertex_count == 0 || frames_ == 0) return placed;
  if (scratch_) write_quantized(placed, buffer);
  json mesh = {{"primitives", primitives(buffer, materials)}};
  // The first frame is the mesh with every weight at 0.
  if (!targets_.empty()) mesh["weights"] = std::vector<int>(targets_.size(), 0);
  placed.mesh = document["meshes"].size();
  document["meshes"].push_back(std::move(mesh));
  return placed;
}

}  // namespace tvg::cli
