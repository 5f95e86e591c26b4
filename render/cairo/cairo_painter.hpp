#pragma once

#include <vector>

#include "render/cairo/cairo_handles.hpp"
#include "render/plot/drawing.hpp"

namespace mapproof {

/// Draws all of `drawing` but its background, in points. `keeps_text`: text is given to the surface
/// with its strings.
/// @param images  Takes the images in it, also where it throws. They have to outlive the surface of
/// a
///                PDF: Cairo copies one that goes before, and Cairo 1.16 dies where it has no
///                memory for the copy.
void paint(const Drawing& drawing, cairo_t* context, bool keeps_text,
           std::vector<SurfaceHandle>& images);

}  // namespace mapproof
