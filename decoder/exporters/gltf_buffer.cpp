#include "decoder/exporters/gltf_buffer.hpp"

#include "decoder/exporters/bytes.hpp"

#include <algorithm>

namespace tvg::cli {

using nlohmann::json;

void GltfBuffer::begin_view(GltfTarget target, std::size_t stride) {
  constexpr std::uint64_t kAlignment = 4;
  static constexpr std::array<char, kAlignment> kPadding{};
  file_.write(kPadding.data(), (kAlignment - file_.size() % kAlignment) % kAlignment);
  view_ = file_.size();
  json view = {{"buffer", 0}, {"byteOffset", *view_}};
  if (stride > 0) view["byteStride"] = stride;
  if (target != GltfTarget::kNone) view["target"] = static_cast<int>(target);
  document_["bufferViews"].push_back(std::move(view));
}

void GltfBuffer::end_view() {
  document_["bufferViews"].back()["byteLength"] = file_.size() - *view_;
  view_.reset();
}

void GltfBuffer::write(std::span<const std::uint8_t> bytes) {
  file_.write(bytes.data(), bytes.size());
}

void GltfBuffer::write(std::span<const float> values) {
  bytes_.resize(values.size_bytes());
  for (std::size_t i = 0; i < values.size(); ++i) store32(bytes_.data() + 4 * i, values[i], false);
  file_.write(bytes_.data(), bytes_.size());
}

void GltfBuffer::write(std::span<const std::uint32_t> values) {
  bytes_.resize(values.size_bytes());
  for (std::size_t i = 0; i < values.size(); ++i) store32(bytes_.data() + 4 * i, values[i], false);
  file_.write(bytes_.data(), bytes_.size());
}

std::size_t GltfBuffer::add_accessor(const GltfAccessor& accessor) {
  json described = {{"bufferView", view()},
                    {"byteOffset", file_.size() - *view_},
                    {"componentType", static_cast<int>(accessor.component)},
                    {"count", accessor.count},
                    {"type", accessor.type}};
  if (accessor.normalized) described["normalized"] = true;
  if (!accessor.least.empty()) {
    described["min"] = accessor.least;
    described["max"] = accessor.most;
  }
  json& accessors = document_["accessors"];
  accessors.push_back(std::move(described));
  return accessors.size() - 1;
}

GltfBounds bounds_of(std::span<const float> values, std::size_t components) {
  GltfBounds bounds;
  if (values.size() < components) return bounds;
  bounds.least.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components));
  bounds.most = bounds.least;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double& least = bounds.least[i % components];
    double& most = bounds.most[i % components];
    least = std::min(least, double{values[i]});
    most = std::max(most, double{values[i]});
  }
  return bounds;
}

}  // namespace tvg::cli
