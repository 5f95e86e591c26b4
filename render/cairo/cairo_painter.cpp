#include "render/cairo/cairo_painter.hpp"

#include <new>
#include <numbers>
#include <stdexcept>

#include <cairo-ft.h>
#include <ft2build.h>

#include "render/theme/font.hpp"

namespace mapproof {
namespace {

/// A face with a library of its own, so that Cairo may drop both whenever it is done with them.
struct FreeTypeFace {
  FontHandle font;  ///< The face reads its bytes.
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  explicit FreeTypeFace(FontHandle of) : font(std::move(of)) {
    const std::string_view bytes = font ? font->bytes() : font_bytes();
    FT_Error error = FT_Init_FreeType(&library);
    if (error == 0)
      error = FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(bytes.data()),
                                 static_cast<FT_Long>(bytes.size()), 0, &face);
    if (error == 0) return;
    FT_Done_FreeType(library);
    if (FT_ERROR_BASE(error) == FT_Err_Out_Of_Memory) throw std::bad_alloc();
    throw std::runtime_error("the font cannot be read");
  }
  ~FreeTypeFace() {
    FT_Done_Face(face);
    FT_Done_FreeType(library);
  }
  FreeTypeFace(const FreeTypeFace&) = delete;
  FreeTypeFace& operator=(const FreeTypeFace&) = delete;
};

FontFaceHandle make_font_face(const FontHandle& font) {
  static const cairo_user_data_key_t key{};
  auto owned = std::make_unique<FreeTypeFace>(font);
  FontFaceHandle made(cairo_ft_font_face_create_for_ft_face(owned->face, FT_LOAD_NO_HINTING));
  check(cairo_font_face_status(made.get()));
  check(cairo_font_face_set_user_data(made.get(), &key, owned.get(),
                                      [](void* face) { delete static_cast<FreeTypeFace*>(face); }));
  static_cast<void>(owned.release());
  return made;
}

class Painter {
 public:
  Painter(const Drawing& drawing, cairo_t* context, bool keeps_text,
          std::vector<SurfaceHandle>& images)
      : drawing_(drawing), context_(context), keeps_text_(keeps_text), images_(images) {
    if (drawing.font) drawing_face_ = make_font_face(drawing.font);
    cairo_set_font_face(context_, drawing_face_ ? drawing_face_.get() : thread_font_face());
    cairo_set_font_options(context_, plain_font_options().get());
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  }

  void paint() {
    for (const Item& item : drawing_.items) {
      if (item.clipped != clipped_ || (item.clipped && item.panel != panel_)) set_clip(item);
      std::visit([this](const auto& what) { draw(what); }, item.what);
    }
  }

 private:
  void set_clip(const Item& item) {
    cairo_reset_clip(context_);
    clipped_ = item.clipped;
    panel_ = item.panel;
    if (!clipped_) return;
    const Box& frame = drawing_.frames[panel_];
    cairo_rectangle(context_, frame.x0, frame.y0, frame.width(), frame.height());
    cairo_clip(context_);
  }

  void set_colour(Colour colour, double opacity) {
    cairo_set_source_rgba(context_, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0,
                          opacity);
  }

  void trace(const Outline& path, Point origin) {
    const Point* next = path.points.data();
    const auto x = [&](std::size_t i) { return next[i].x + origin.x; };
    const auto y = [&](std::size_t i) { return next[i].y + origin.y; };
    for (const PathCommand command : path.commands) {
      switch (command) {
        case PathCommand::kMove:
          cairo_move_to(context_, x(0), y(0));
          next += 1;
          break;
        case PathCommand::kLine:
          cairo_line_to(context_, x(0), y(0));
          next += 1;
          break;
        case PathCommand::kQuad:
          trace_quad(x(0), y(0), x(1), y(1)), next += 2;
          break;
        case PathCommand::kCubic:
          cairo_curve_to(context_, x(0), y(0), x(1), y(1), x(2), y(2));
          next += 3;
          break;
        case PathCommand::kClose:
          cairo_close_path(context_);
          break;
      }
    }
  }

  void trace_quad(double cx, double cy, double x, double y) {
    double from_x = 0.0, from_y = 0.0;
    cairo_get_current_point(context_, &from_x, &from_y);
    cairo_curve_to(context_, (from_x + 2 * cx) / 3, (from_y + 2 * cy) / 3, (x + 2 * cx) / 3,
                   (y + 2 * cy) / 3, x, y);
  }

  void draw_at(const Shape& shape, Point origin) {
    trace(shape.path, origin);
    if (shape.fill) {
      set_colour(*shape.fill, shape.fill_opacity);
      shape.stroke ? cairo_fill_preserve(context_) : cairo_fill(context_);
    }
    if (!shape.stroke) return;
    set_colour(shape.stroke->colour, 1.0);
    cairo_set_line_width(context_, shape.stroke->width);
    cairo_set_line_cap(context_,
                       shape.stroke->is_round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    const auto& dashes = shape.stroke->dashes;
    cairo_set_dash(context_, dashes.data(), static_cast<int>(dashes.size()), 0.0);
    cairo_stroke(context_);
  }

  void draw(const Shape& shape) { draw_at(shape, {}); }
  void draw(const Stamp& stamp) {
    const Shape& symbol = drawing_.symbols[stamp.symbol];
    symbol.circle_radius > 0.0 ? draw_circle(symbol, stamp.at) : draw_at(symbol, stamp.at);
  }

  /// A ring as a disc on a disc: half the time of a stroke, and maps are made of circles.
  void draw_circle(const Shape& circle, Point at) {
    const double half = circle.stroke ? circle.stroke->width / 2.0 : 0.0;
    if (circle.stroke) fill_disc(at, circle.circle_radius + half, circle.stroke->colour);
    fill_disc(at, circle.circle_radius - half, *circle.fill);
  }

  void fill_disc(Point at, double radius, Colour colour) {
    cairo_new_sub_path(context_);
    cairo_arc(context_, at.x, at.y, radius, 0.0, 2.0 * std::numbers::pi);
    set_colour(colour, 1.0);
    cairo_fill(context_);
  }

  void draw(const Raster& raster) {
    if (raster.image == nullptr) return;
    const Image& image = *raster.image;
    // Cairo only reads it; pixels without alpha are Image's own form.
    auto* pixels = reinterpret_cast<unsigned char*>(const_cast<std::uint32_t*>(image.row(0)));
    const SurfaceHandle& surface = images_.emplace_back(cairo_image_surface_create_for_data(
        pixels, CAIRO_FORMAT_RGB24, image.width, image.height, 4 * image.width));
    check(cairo_surface_status(surface.get()));
    cairo_save(context_);
    cairo_translate(context_, raster.position.x0, raster.position.y0);
    cairo_scale(context_, raster.position.width() / image.width,
                raster.position.height() / image.height);
    cairo_set_source_surface(context_, surface.get(), 0.0, 0.0);
    cairo_pattern_set_filter(cairo_get_source(context_), CAIRO_FILTER_NEAREST);
    cairo_paint(context_);
    cairo_restore(context_);
  }

  void draw(const TextLine& line) {
    set_colour(line.colour, 1.0);
    cairo_save(context_);
    cairo_translate(context_, line.at.x, line.at.y);
    if (line.upward) cairo_rotate(context_, -std::numbers::pi / 2.0);
    cairo_set_font_size(context_, line.size);
    std::vector<cairo_glyph_t> glyphs;
    glyphs.reserve(line.shaped.glyphs.size());
    for (const Glyph& glyph : line.shaped.glyphs)
      glyphs.push_back({glyph.index, glyph.x * line.size, glyph.y * line.size});
    if (keeps_text_)
      show_text(line.shaped, glyphs);
    else
      cairo_show_glyphs(context_, glyphs.data(), static_cast<int>(glyphs.size()));
    cairo_restore(context_);
  }

  void show_text(const ShapedText& shaped, const std::vector<cairo_glyph_t>& glyphs) {
    for (const TextRun& run : shaped.runs) {
      std::vector<cairo_text_cluster_t> clusters;
      std::size_t bytes = 0, count = 0;
      for (const Cluster& cluster : run.clusters) {
        clusters.push_back({static_cast<int>(cluster.bytes), static_cast<int>(cluster.glyphs)});
        bytes += cluster.bytes;
        count += cluster.glyphs;
      }
      cairo_show_text_glyphs(
          context_, shaped.text.data() + run.first_byte, static_cast<int>(bytes),
          glyphs.data() + run.first_glyph, static_cast<int>(count), clusters.data(),
          static_cast<int>(clusters.size()),
          run.right_to_left ? CAIRO_TEXT_CLUSTER_FLAG_BACKWARD : cairo_text_cluster_flags_t{});
    }
  }

  const Drawing& drawing_;
  cairo_t* context_;
  bool keeps_text_;
  std::vector<SurfaceHandle>& images_;
  FontFaceHandle drawing_face_;
  bool clipped_ = false;
  std::size_t panel_ = 0;
};

}  // namespace

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("Cairo: ") + cairo_status_to_string(status));
}

cairo_font_face_t* thread_font_face() {
  static thread_local const FontFaceHandle face = make_font_face(nullptr);
  return face.get();
}

FontOptionsHandle plain_font_options() {
  FontOptionsHandle options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  return options;
}

void paint(const Drawing& drawing, cairo_t* context, bool keeps_text,
           std::vector<SurfaceHandle>& images) {
  Painter(drawing, context, keeps_text, images).paint();
}

}  // namespace mapproof
