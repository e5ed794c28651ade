#include "cli/compared_properties.hpp"

#include "tool/tool_error.hpp"

#include <span>
#include <utility>
#include <vector>

namespace tvg::cli {

namespace {

PropertyComparison comparison_of(const FrameSource& original, const FrameSource& decoded,
                                 const std::string& name) {
  Result<PropertyComparison> made =
      PropertyComparison::of(original.mesh(), original.properties(), decoded.mesh(), decoded.properties());
  if (!made) throw tool_error(name, made.error());
  return std::move(*made);
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
  const std::vector<std::span<const float>> original = all_animated_values(original_);
  const std::vector<std::span<const float>> decoded = all_animated_values(decoded_);
  if (Status status = comparison_.add_frame(original, decoded); !status.ok())
    throw tool_error(name_, status.error());
}

}  // namespace tvg::cli
