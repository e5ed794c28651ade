#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

// Free-form data that have something of each frame of a stream (tvg/properties.hpp): when it is, or where its
// joints are.
namespace tvg {

bool is_frame_data(std::string_view name);

/// Of such data of a sequence of `frames` frames those of the frames of a part. Data that do not come out
/// even stay whole over all parts: the last has the rest.
NamedData cut_frame_data(const NamedData& data, std::uint64_t frames, const FrameRange& part);

/// One after the other what cut_frame_data() cut, or what else has the same name. Nothing where times would
/// go back, or there would be more than a stream may hold.
bool join_frame_data(NamedData& data, const NamedData& next);

}  // namespace tvg
