#pragma once

#include <memory>
#include <vector>

#include <cairo.h>

#include "render/plot/drawing.hpp"

namespace mapproof {

struct SurfaceDelete {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDelete {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
struct FontFaceDelete {
  void operator()(cairo_font_face_t* face) const { cairo_font_face_destroy(face); }
};
struct FontOptionsDelete {
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};

using SurfaceHandle = std::unique_ptr<cairo_surface_t, SurfaceDelete>;
using ContextHandle = std::unique_ptr<cairo_t, ContextDelete>;
using FontFaceHandle = std::unique_ptr<cairo_font_face_t, FontFaceDelete>;
using FontOptionsHandle = std::unique_ptr<cairo_font_options_t, FontOptionsDelete>;

/// @throws std::bad_alloc if it is for want of memory; std::runtime_error with Cairo's words if
///         something else went wrong.
void check(cairo_status_t status);

/// The embedded font for this thread alone, made at its first call; FreeType faces cannot be
/// shared.
cairo_font_face_t* thread_font_face();

/// No hinting, grey antialiasing: the same outlines at every size and place.
FontOptionsHandle plain_font_options();

/// Draws all of `drawing` but its background, in points. `keeps_text`: text is given to the surface
/// with its strings.
/// @param images  Takes the images in it, also where it throws. They have to outlive the surface of
/// a
///                PDF: Cairo copies one that goes before, and Cairo 1.16 dies where it has no
///                memory for the copy.
void paint(const Drawing& drawing, cairo_t* context, bool keeps_text,
           std::vector<SurfaceHandle>& images);

}  // namespace mapproof
