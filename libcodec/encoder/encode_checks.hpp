#pragma once
#include <span>

#include <tvg/encoder.hpp>

// What an encoder is told is checked before it writes a byte.
namespace tvg {

/// Whether levels, where they are not null, and the coarser meshes over them are those of such a mesh:
/// kInvalidArgument.
Status check_levels(const MeshLevels* levels, const Mesh& mesh);

/// kInvalidArgument, with what would be right, for options out of range and for metadata no stream can hold.
Status check_options(const EncodeOptions& options);
/// The same for options of an encoder that is pushed.
Status check_pushed(const EncodeOptions& options);
/// Whether meshes are written with a reference shape.
bool needs_shape(const EncodeOptions& options);
/// The cells of such a shape, which is made of this frame: a quarter of the lattice's, for a shape that is
/// finer than what it predicts pays.
double shape_cell(const EncodeOptions& options, std::span<const float> first_frame);
/// Whether the box of the whole source is of use that is not given.
bool needs_box(const EncodeOptions& options);

/// Frames that are encoded together: those of a GOP, or of a period.
std::uint32_t frames_at_once(const EncodeOptions& options);
/// Turns a bound of errors into a step: of the diagonal of the options' box, if so, and less what the
/// rounding of positions in that box to float32 takes. kInvalidArgument where there is no box, or nothing is
/// left.
Status resolve_max_error(EncodeOptions& options);

/// What the head of a stream declares whose meshes are at most as large as this one and as the options say,
/// with properties that take so many bytes or as many as the options say.
StreamLimits limits_for(const Mesh& mesh, const EncodeOptions& options, std::uint64_t property_bytes,
                        std::uint64_t animated_frame_bytes);

/// Adds data whose names are not there yet.
void add_data(std::vector<NamedData>& data, std::span<const NamedData> more);

}  // namespace tvg
