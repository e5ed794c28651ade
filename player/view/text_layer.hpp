#pragma once
#include "tool/colour_map.hpp"

#include <string>

struct ImDrawList;
struct ImGuiContext;

namespace tvg::player {

/// A colour bar with what its colours mean.
struct Legend {
  cli::ColourMap map = cli::ColourMap::kViridis;
  std::string title;    ///< "error"
  std::string note;     ///< a second, smaller line; may be empty
  double smallest = 0;  ///< values at the bar's ends; of no meaning for kFlags
  double largest = 1;
  std::string units;  ///< of the values, may be empty
  std::string plain;  ///< kFlags: what the two colours stand for
  std::string flagged;
};

/// Where text goes, in pixels from the upper left corner, and how large it is.
struct TextPlace {
  float x = 0;
  float y = 0;
  float size = 16;
};

/// Gives the present ImGui a font of this system, or its own where there is none, whose letters look best at
/// `size` pixels.
void load_font(float size);

/// Height of letters that suit a picture of this many pixels in height.
float text_size(int picture_height);

/// A line of text on a soft plate at `place`, its upper left corner. ImGui must have a frame begun.
void draw_label(ImDrawList& list, const TextPlace& place, const std::string& text);

struct TextExtent {
  float width = 0;
  float height = 0;
};

/// What a legend covers, in pixels, with letters of `size`. ImGui must have a frame begun.
TextExtent legend_extent(const Legend& legend, float size);

/// The legend; `place` is its upper left corner. ImGui must have a frame begun.
void draw_legend(ImDrawList& list, const TextPlace& place, const Legend& legend);

/// Text over a picture that has no window: a Dear ImGui of its own, without keyboard and mouse. Needs a
/// current OpenGL 3.3 context for as long as it lives.
class TextLayer {
 public:
  /// `largest_size`: of the letters that will be drawn, in pixels. Throws ToolError (kOther).
  explicit TextLayer(float largest_size);
  ~TextLayer();
  TextLayer(const TextLayer&) = delete;
  TextLayer& operator=(const TextLayer&) = delete;

  /// Begins the text of a picture; what is drawn to the list appears with end(). The list is valid until
  /// then.
  ImDrawList& begin(int width, int height);
  /// Draws the text into the framebuffer that is bound.
  void end();

 private:
  ImGuiContext* context_;
};

}  // namespace tvg::player
