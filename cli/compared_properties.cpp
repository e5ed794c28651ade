#include "cli/compared_properties.hpp"

#include "tool/tool_error.hpp"

#include <utility>

namespace tvg::cli {

namespace {

PropertyComparison comparison_of(const FrameSource& original, const FrameSource& decoded,
                                 const std::string& name) {
  Result<PropertyComparison> made =
      PropertyComparison::of(original.mesh(), original.properties(), decoded.mesh(), decoded.properties());
  if (!made) throw tool_error(name, made.error());
  return std::move(*made);
}

void take_values(const FrameSource& source, std::vector<std::span<const float>>& values) {
  const std::vector<Attribute>& attributes = source.properties().attributes;
  values.assign(attributes.size(), {});
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    if (attributes[i].animated) values[i] = source.animated_values(i);
  }
}

}  // namespace

ComparedProperties::ComparedProperties(const FrameSource& original, const FrameSource& decoded,
                                       std::string name)
    : original_(original),
      decoded_(decoded),
      name_(std::move(name)),
      comparison_(comparison_of(original, decoded, name_)) {}

void ComparedProperties::add_frame() {
  if (!comparison_.wants_frames()) return;
  take_values(original_, original_values_);
  take_values(decoded_, decoded_values_);
  if (Status status = comparison_.add_frame(original_values_, decoded_values_); !status.ok())
    throw tool_error(name_, status.error());
}

}  // namespace tvg::cli
