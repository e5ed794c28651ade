#pragma once
#include <optional>

#include <tvg/parts.hpp>

namespace tvg {

/// Options as they are for all frames of one source.
struct SettledOptions {
  EncodeOptions options;
  /// Each frame has a mesh of its own, and that is made use of (EncodeOptions::suit_captured).
  bool captured = false;
};

/// Whether encode() with these options looks at all frames before it encodes the first.
bool needs_plan(const FrameSource& source, const EncodeOptions& options);

/// What kInvalidArgument or kInvalidInput there is to be said of the options and of what the source begins
/// with.
Status check_encoding(const FrameSource& source, const EncodeOptions& options);

/// Completes the options by what the source and, where there is one and it is needed, a plan say. The source
/// stands at its first frame. kInvalidArgument for a largest error that the box of the frames leaves no room
/// for. Free-form data of the source are left to the caller.
Result<SettledOptions> settle_options(const FrameSource& source, EncodeOptions options,
                                      const EncodePlan* plan);

}  // namespace tvg
