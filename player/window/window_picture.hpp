#pragma once
#include "player/view/image.hpp"

#include <string>

namespace tvg::player {

/// The pixels of the window as they are before they are presented.
Image window_picture(int width, int height);

/// A name for a picture that no file in the present folder has yet: "tvg-001.png".
std::string free_picture_name();

}  // namespace tvg::player
