#include "render/cairo/cairo_font.hpp"

#include <new>
#include <stdexcept>

#include <cairo-ft.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include "render/theme/font.hpp"

namespace mapproof {
namespace {

/// A face with a library of its own, so that Cairo may drop both whenever it is done with them.
struct FreeTypeFace {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  FreeTypeFace() {
    const std::string_view bytes = font_bytes();
    FT_Error error = FT_Init_FreeType(&library);
    if (error == 0)
      error = FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(bytes.data()),
                                 static_cast<FT_Long>(bytes.size()), 0, &face);
    if (error == 0) return;
    FT_Done_FreeType(library);
    if (FT_ERROR_BASE(error) == FT_Err_Out_Of_Memory) throw std::bad_alloc();
    throw std::runtime_error("the embedded font cannot be read");
  }
  ~FreeTypeFace() {
    FT_Done_Face(face);
    FT_Done_FreeType(library);
  }
  FreeTypeFace(const FreeTypeFace&) = delete;
  FreeTypeFace& operator=(const FreeTypeFace&) = delete;
};

FontFaceHandle make_font_face() {
  static const cairo_user_data_key_t key{};
  auto owned = std::make_unique<FreeTypeFace>();
  FontFaceHandle made(cairo_ft_font_face_create_for_ft_face(owned->face, FT_LOAD_NO_HINTING));
  check(cairo_font_face_status(made.get()));
  check(cairo_font_face_set_user_data(made.get(), &key, owned.get(),
                                      [](void* face) { delete static_cast<FreeTypeFace*>(face); }));
  owned.release();
  return made;
}

}  // namespace

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("Cairo: ") + cairo_status_to_string(status));
}

cairo_font_face_t* thread_font_face() {
  static thread_local const FontFaceHandle face = make_font_face();
  return face.get();
}

FontOptionsHandle plain_font_options() {
  FontOptionsHandle options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  return options;
}

}  // namespace mapproof
