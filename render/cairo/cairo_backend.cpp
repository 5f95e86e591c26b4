#include "render/cairo/cairo_backend.hpp"

#include <cerrno>
#include <cmath>
#include <new>
#include <numbers>
#include <stdexcept>

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <ft2build.h>

#include "core/base/errors.hpp"
#include "render/cairo/library_versions.hpp"
#include "render/image/png.hpp"
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

class Painter {
 public:
  Painter(const Drawing& drawing, cairo_t* context, bool keeps_text,
          std::vector<SurfaceHandle>& images)
      : drawing_(drawing), context_(context), keeps_text_(keeps_text), images_(images) {
    cairo_set_font_face(context_, thread_font_face());
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
    cairo_translate(context_, raster.place.x0, raster.place.y0);
    cairo_scale(context_, raster.place.width() / image.width, raster.place.height() / image.height);
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
  bool clipped_ = false;
  std::size_t panel_ = 0;
};

constexpr const char* kFixedDate = "2000-01-01T00:00:00Z";

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) (text += text.empty() ? "" : "\n") += part;
  return visible_lines(text);
}

/// "mapproof (Cairo 1.16.0, FreeType 2.12.1, HarfBuzz 6.0.0)": all that pixels depend on.
const std::string& drawing_software() {
  static const std::string software = [] {
    std::string versions;
    for (const auto& [library, version] : render_library_versions())
      if (library != "libdeflate")
        versions += (versions.empty() ? "" : ", ") + library + " " + version;
    return "mapproof (" + versions + ")";
  }();
  return software;
}

cairo_status_t append_to(void* bytes, const unsigned char* data, unsigned length) {
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::bad_alloc&) {  // Not through Cairo, which may hold a lock.
    return CAIRO_STATUS_NO_MEMORY;
  }
}

void set_words(const Drawing& drawing, cairo_surface_t* surface) {
  const auto set = [surface](cairo_pdf_metadata_t what, const std::string& text) {
    cairo_pdf_surface_set_metadata(surface, what, text.c_str());
  };
  set(CAIRO_PDF_METADATA_TITLE, visible_lines(drawing.title));
  set(CAIRO_PDF_METADATA_SUBJECT, visible_lines(drawing.alt));
  set(CAIRO_PDF_METADATA_KEYWORDS, drawing.id + " " + joined(drawing.record_ids) +
                                       (drawing.renderer.empty() ? "" : " " + drawing.renderer));
  set(CAIRO_PDF_METADATA_CREATOR, "mapproof");
  set(CAIRO_PDF_METADATA_CREATE_DATE, kFixedDate);
}

/// Draws the only page and closes the file.
void draw_pdf(const Drawing& drawing, cairo_surface_t* surface,
              std::vector<SurfaceHandle>& images) {
  set_words(drawing, surface);
  const ContextHandle context(cairo_create(surface));
  const Colour paper = drawing.background;
  cairo_set_source_rgb(context.get(), paper.red / 255.0, paper.green / 255.0, paper.blue / 255.0);
  cairo_paint(context.get());
  paint(drawing, context.get(), true, images);
  cairo_show_page(context.get());
  check(cairo_status(context.get()));
  cairo_surface_finish(surface);
  check(cairo_surface_status(surface));
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

void paint(const Drawing& drawing, cairo_t* context, bool keeps_text,
           std::vector<SurfaceHandle>& images) {
  Painter(drawing, context, keeps_text, images).paint();
}

Image to_image(const Drawing& drawing) {
  const double scale = drawing.dpi / 72.0;
  Image image;
  image.width = static_cast<int>(std::lround(std::min(drawing.width * scale, 1e6)));
  image.height = static_cast<int>(std::lround(std::min(drawing.height * scale, 1e6)));
  if (image.width < 1 || image.height < 1 || image.width > 20000 || image.height > 20000)
    throw InvalidInput("figure " + drawing.id + ": no picture is " + std::to_string(image.width) +
                       " x " + std::to_string(image.height) + " pixels");
  const Colour paper = drawing.background;
  image.pixels.assign(static_cast<std::size_t>(image.width) * image.height,
                      paper.red << 16 | paper.green << 8 | paper.blue);
  const SurfaceHandle surface(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(image.pixels.data()), CAIRO_FORMAT_RGB24, image.width,
      image.height, 4 * image.width));
  const ContextHandle context(cairo_create(surface.get()));
  cairo_scale(context.get(), image.width / drawing.width, image.height / drawing.height);
  std::vector<SurfaceHandle> images;
  paint(drawing, context.get(), false, images);
  check(cairo_status(context.get()));
  cairo_surface_flush(surface.get());
  check(cairo_surface_status(surface.get()));
  return image;
}

std::vector<std::pair<std::string, std::string>> png_words(const Drawing& drawing) {
  std::vector<std::pair<std::string, std::string>> words = {
      {"Title", visible_lines(drawing.title)},
      {"Description", visible_lines(drawing.alt)},
      {"Software", drawing_software()},
      {"mapproof:figure", drawing.id},
      {"mapproof:records", joined(drawing.record_ids)}};
  if (!drawing.renderer.empty()) words.emplace_back("mapproof:renderer", drawing.renderer);
  return words;
}

std::string to_png(const Drawing& drawing) {
  return encode_png(to_image(drawing), {.dpi = drawing.dpi, .texts = png_words(drawing)});
}

std::string to_pdf(const Drawing& drawing) {
  std::string bytes;
  errno = 0;
  std::vector<SurfaceHandle> images;
  SurfaceHandle surface(
      cairo_pdf_surface_create_for_stream(append_to, &bytes, drawing.width, drawing.height));
  // Cairo 1.16 makes a copy of an image before it destroys it, and dies where it has no memory for
  // that. So the images stay: less than 1 KiB each, the pixels belong to the drawing.
  const auto keep = [&images] {
    for (SurfaceHandle& image : images) image.release();
  };
  try {
    draw_pdf(drawing, surface.get(), images);
    // Nor does it report every piece of memory that it did not get.
    if (errno == ENOMEM) throw std::bad_alloc();
  } catch (...) {
    // Cairo goes on with what failed when such a surface is closed, up to an abort.
    surface.release();
    keep();
    throw;
  }
  keep();
  return bytes;
}

}  // namespace mapproof
