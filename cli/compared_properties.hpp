#pragma once
#include <string>

#include <tvg/property_metrics.hpp>
#include <tvg/source.hpp>

namespace tvg::cli {

/// What two sources have beside positions, held against each other while their frames are read. Both sources
/// stay with the meshes they have now as long as this is in use.
class ComparedProperties {
 public:
  /// Throws ToolError where they cannot be compared; `name` is that of the decoded side in messages.
  ComparedProperties(const FrameSource& original, const FrameSource& decoded, std::string name);

  /// Takes what both have of the frame that was read last. Throws ToolError.
  void add_frame();
  PropertyReport report() const { return comparison_.report(); }

 private:
  const FrameSource& original_;
  const FrameSource& decoded_;
  std::string name_;
  PropertyComparison comparison_;
};

}  // namespace tvg::cli
