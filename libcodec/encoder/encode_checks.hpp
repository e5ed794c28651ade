#pragma once
#include <tvg/encoder.hpp>

// What an encoder is told is checked before it writes a byte.
namespace tvg {

/// kInvalidArgument, with what would be right, for options out of range and for metadata no stream can hold.
Status check_options(const EncodeOptions& options);
/// Whether meshes are written with a reference shape.
bool needs_shape(const EncodeOptions& options);

/// What the head of a stream declares whose meshes are at most as large as this one and as the options say.
StreamLimits limits_for(const Mesh& mesh, const EncodeOptions& options);

}  // namespace tvg
