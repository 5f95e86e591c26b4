#pragma once

#include "render/cairo/cairo_handles.hpp"

namespace mapproof {

/// The embedded font for this thread alone, made at its first call; FreeType faces cannot be
/// shared.
cairo_font_face_t* thread_font_face();

/// No hinting, grey antialiasing: the same outlines at every size and place.
FontOptionsHandle plain_font_options();

}  // namespace mapproof
