#pragma once

#include <memory>

#include <cairo.h>

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

}  // namespace mapproof
