#include "decoder/exporters/gltf_attributes.hpp"

#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

constexpr std::array<const char*, 5> kTypes = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};

/// The values that render vertices have.
std::vector<float> spread(const RenderView& view, std::size_t attribute, std::size_t components,
                          std::span<const float> values) {
  std::vector<float> all(components * view.vertex_count());
  const Status status = view.copy_attribute(attribute, values, std::as_writable_bytes(std::span(all)),
                                            components * sizeof(float));
  if (!status.ok()) throw ToolError(ExitStatus::kOther, "glTF: " + status.error().message);
  return all;
}

class AttributeWriter {
 public:
  AttributeWriter(const RenderView& view, const MeshFrame& frame, GltfBuffer& buffer)
      : view_(view), frame_(frame), buffer_(buffer) {}

  GltfAttributes write() {
    result_.normal = known_attributes(frame_.properties).normal;
    for (std::size_t i = 0; i < frame_.properties.attributes.size(); ++i) {
      const Attribute& attribute = frame_.properties.attributes[i];
      const std::span<const float> values = values_of(frame_, i);
      if (values.empty() || attribute.domain == AttributeDomain::kPart) continue;
      if (i == result_.normal) {
        result_.normals = gltf_normals(view_, i, values);
        write_floats("NORMAL", 3, result_.normals);
        keep_name("NORMAL", attribute);
      } else {
        write_one(attribute, spread(view_, i, attribute.components, values));
      }
    }
    return std::move(result_);
  }

 private:
  void write_one(const Attribute& attribute, const std::vector<float>& values) {
    const std::size_t components = attribute.components;
    if (attribute.kind == AttributeKind::kTexcoord && components >= 2) {
      keep_name(fmt::format("TEXCOORD_{}", result_.texcoord_sets), attribute);
      write_texcoords(components, values);
    } else if (attribute.kind == AttributeKind::kColour && components >= 3) {
      keep_name(fmt::format("COLOR_{}", colour_sets_), attribute);
      write_colours(components, values);
    } else {
      const std::string name = name_of(attribute);
      keep_name(name, attribute);
      write_floats(name, components, values);
    }
  }

  void write_texcoords(std::size_t components, const std::vector<float>& values) {
    std::vector<float> turned;
    turned.reserve(2 * view_.vertex_count());
    for (std::size_t i = 0; i < values.size(); i += components) {
      turned.push_back(values[i]);
      turned.push_back(1 - values[i + 1]);
    }
    write_floats(fmt::format("TEXCOORD_{}", result_.texcoord_sets++), 2, turned);
  }

  void write_colours(std::size_t components, std::vector<float> values) {
    const std::string name = fmt::format("COLOR_{}", colour_sets_++);
    if (!are_bytes(values)) {
      for (float& value : values) value = std::clamp(value, 0.0F, 1.0F);
      write_floats(name, components, values);
      return;
    }
    constexpr std::size_t kStride = 4;  // elements begin at multiples of four bytes
    std::vector<std::uint8_t> bytes(kStride * view_.vertex_count());
    for (std::size_t i = 0; i < values.size(); ++i) {
      bytes[kStride * (i / components) + i % components] =
          static_cast<std::uint8_t>(std::lround(255 * values[i]));
    }
    buffer_.begin_view(GltfTarget::kVertices, kStride);
    result_.accessors[name] = buffer_.add_accessor(
        {GltfComponent::kUnsignedByte, kTypes[components], view_.vertex_count(), true, {}, {}});
    buffer_.write(std::span<const std::uint8_t>(bytes));
    buffer_.end_view();
  }

  void write_floats(const std::string& name, std::size_t components, const std::vector<float>& values) {
    buffer_.begin_view(GltfTarget::kVertices);
    result_.accessors[name] = buffer_.add_accessor(
        {GltfComponent::kFloat, kTypes[components], view_.vertex_count(), false, {}, {}});
    buffer_.write(std::span<const float>(values));
    buffer_.end_view();
  }

  void keep_name(const std::string& in_gltf, const Attribute& attribute) {
    if (attribute.name != in_gltf) result_.names[in_gltf] = attribute.name;
  }

  /// Names of one's own begin with an underscore and have no lower-case letters.
  std::string name_of(const Attribute& attribute) const {
    std::string name = attribute.name.starts_with("_") ? attribute.name : "_" + attribute.name;
    for (char& c : name) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
      if (!((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
    }
    if (name == "_") name = "_VALUE";
    const std::string stem = name;
    for (int number = 2; result_.accessors.contains(name); ++number)
      name = fmt::format("{}_{}", stem, number);
    return name;
  }

  const RenderView& view_;
  const MeshFrame& frame_;
  GltfBuffer& buffer_;
  GltfAttributes result_;
  std::size_t colour_sets_ = 0;
};

}  // namespace

std::vector<float> gltf_normals(const RenderView& view, std::size_t attribute,
                                std::span<const float> values) {
  std::vector<float> normals = spread(view, attribute, 3, values);
  for (std::size_t i = 0; i + 2 < normals.size(); i += 3) {
    const double length = std::hypot(double{normals[i]}, double{normals[i + 1]}, double{normals[i + 2]});
    if (length > 0 && std::isfinite(length)) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        normals[i + axis] = static_cast<float>(double{normals[i + axis]} / length);
    } else {
      normals[i] = normals[i + 1] = 0;
      normals[i + 2] = 1;
    }
  }
  return normals;
}

GltfAttributes write_gltf_attributes(const RenderView& view, const MeshFrame& frame, GltfBuffer& buffer) {
  return AttributeWriter(view, frame, buffer).write();
}

}  // namespace tvg::cli
