#pragma once
#include "player/view/image.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace tvg::player {

/// The picture in the bytes of a PNG or JPEG file, of at most 8192 pixels a side; nothing where that is
/// something else or broken. May be given any bytes.
std::optional<Image> decode_picture(std::span<const std::uint8_t> bytes);

}  // namespace tvg::player
