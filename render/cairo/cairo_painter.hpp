#pragma once

#include "render/cairo/cairo_handles.hpp"
#include "render/plot/drawing.hpp"

namespace mapproof {

/// Draws all of `drawing` but its background, in points. `keeps_text`: text is given to the surface
/// with its strings.
void paint(const Drawing& drawing, cairo_t* context, bool keeps_text);

}  // namespace mapproof
