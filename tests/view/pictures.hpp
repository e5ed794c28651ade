#pragma once
#include "player/view/image.hpp"

#include <span>
#include <string_view>

namespace tvg::player::testing {

/// A picture that is stored beside the tests.
struct StoredPicture {
  std::string_view name;  ///< of tests/view/pictures/NAME.png
  Image (*draw)();        ///< needs a machine that draws without a display
};

/// Every picture: 256 x 192 pixels, without text.
std::span<const StoredPicture> stored_pictures();

// Parts of which wrong pictures are made.
Image draw_hand(std::size_t frame);
Image draw_hand_without_some_faces();
Image draw_hand_in_another_colour();

}  // namespace tvg::player::testing
