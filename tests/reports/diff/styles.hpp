#pragma once

#include <cairo.h>

#include "render/image/image.hpp"
#include "render/plot/drawing.hpp"

namespace mapproof::test {

/// How another version or setting of a drawing library would draw the same shapes.
struct Style {
  cairo_antialias_t shapes = CAIRO_ANTIALIAS_DEFAULT;
  cairo_antialias_t text = CAIRO_ANTIALIAS_GRAY;
  cairo_hint_style_t hinting = CAIRO_HINT_STYLE_NONE;
  /// Text as filled outlines. Otherwise `text` and `hinting` determine it, and glyphs are on
  /// whole pixels.
  bool outlined = true;
  bool font_hints = true;                ///< Of the font, else FreeType's.
  double right_px = 0.0, down_px = 0.0;  ///< All of it is moved by so much.
};

/// The drawing as pixels; all text lies on top of the rest.
Image drawn(const Drawing& drawing, const Style& style = {});

}  // namespace mapproof::test
