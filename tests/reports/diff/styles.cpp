#include "tests/reports/diff/styles.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <cairo-ft.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include "render/cairo/cairo_painter.hpp"

namespace mapproof::test {
namespace {

/// The embedded font with hinting, for this thread; the face the back end draws with has none.
cairo_font_face_t* hinted_face(bool font_hints) {
  struct Faces {
    FT_Library library = nullptr;
    FT_Face face = nullptr;
    FontFaceHandle own, automatic;
    Faces() {
      const std::string_view bytes = font_bytes();
      if (FT_Init_FreeType(&library) != 0 ||
          FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(bytes.data()),
                             static_cast<FT_Long>(bytes.size()), 0, &face) != 0)
        throw std::runtime_error("the font cannot be read");
      own.reset(cairo_ft_font_face_create_for_ft_face(face, FT_LOAD_DEFAULT));
      automatic.reset(cairo_ft_font_face_create_for_ft_face(face, FT_LOAD_FORCE_AUTOHINT));
    }
  };
  // Cairo keeps the face in its caches for longer than a thread lives.
  thread_local const Faces* const faces = new Faces();
  return font_hints ? faces->own.get() : faces->automatic.get();
}

void draw_text(const TextLine& line, bool outlined, cairo_t* context) {
  const Colour colour = line.colour;
  cairo_save(context);
  cairo_set_source_rgb(context, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
  cairo_translate(context, line.at.x, line.at.y);
  if (line.upward) cairo_rotate(context, -std::numbers::pi / 2.0);
  cairo_set_font_size(context, line.size);
  std::vector<cairo_glyph_t> glyphs;
  for (const Glyph& glyph : line.shaped.glyphs)
    glyphs.push_back({glyph.index, glyph.x * line.size, glyph.y * line.size});
  const int count = static_cast<int>(glyphs.size());
  if (outlined) {
    cairo_new_path(context);
    cairo_glyph_path(context, glyphs.data(), count);
    cairo_fill(context);
  } else {
    cairo_show_glyphs(context, glyphs.data(), count);
  }
  cairo_restore(context);
}

}  // namespace

Image drawn(const Drawing& drawing, const Style& style) {
  const double scale = drawing.dpi / 72.0;
  Image image{static_cast<int>(std::lround(drawing.width * scale)),
              static_cast<int>(std::lround(drawing.height * scale)),
              {}};
  const Colour paper = drawing.background;
  image.pixels.assign(static_cast<std::size_t>(image.width) * image.height,
                      paper.red << 16 | paper.green << 8 | paper.blue);
  const SurfaceHandle surface(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(image.pixels.data()), CAIRO_FORMAT_RGB24, image.width,
      image.height, 4 * image.width));
  const ContextHandle context(cairo_create(surface.get()));
  cairo_translate(context.get(), style.right_px, style.down_px);
  cairo_scale(context.get(), image.width / drawing.width, image.height / drawing.height);
  cairo_set_antialias(context.get(), style.shapes);

  Drawing shapes = drawing;
  std::erase_if(shapes.items,
                [](const Item& item) { return std::holds_alternative<TextLine>(item.what); });
  std::vector<SurfaceHandle> images;
  paint(shapes, context.get(), false, images);
  cairo_reset_clip(context.get());
  cairo_set_antialias(context.get(), CAIRO_ANTIALIAS_DEFAULT);
  const FontOptionsHandle options = plain_font_options();
  cairo_font_options_set_antialias(options.get(), style.text);
  cairo_font_options_set_hint_style(options.get(), style.hinting);
  cairo_set_font_options(context.get(), options.get());
  cairo_set_font_face(context.get(),
                      style.outlined ? thread_font_face() : hinted_face(style.font_hints));
  for (const Item& item : drawing.items)
    if (const auto* line = std::get_if<TextLine>(&item.what))
      draw_text(*line, style.outlined, context.get());
  check(cairo_status(context.get()));
  cairo_surface_flush(surface.get());
  for (std::uint32_t& pixel : image.pixels) pixel &= 0xFFFFFF;
  return image;
}

}  // namespace mapproof::test
