#include "render/cairo/cairo_backend.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <mutex>
#include <new>

#include <cairo-pdf.h>
#include <cairo-ps.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/huge_pages.hpp"
#include "render/cairo/cairo_painter.hpp"
#include "render/cairo/library_versions.hpp"
#include "render/image/png.hpp"

namespace mapproof {
namespace {

constexpr const char* kFixedDate = "2000-01-01T00:00:00Z";

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) (text += text.empty() ? "" : "\n") += part;
  return visible_lines(text);
}

/// "mapproof (Cairo 1.16.0, FreeType 2.12.1, HarfBuzz 6.0.0)": all that pixels depend on.
const std::string& drawing_software() {
  static const std::string software = [] {
    std::vector<std::string> versions;
    for (const auto& [library, version] : render_library_versions())
      if (library != "libdeflate") versions.push_back(fmt::format("{} {}", library, version));
    return fmt::format("mapproof ({})", fmt::join(versions, ", "));
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

/// The header of an EPS file; a line of it holds 255 bytes.
void set_eps_words(const Drawing& drawing, cairo_surface_t* surface) {
  cairo_ps_surface_set_eps(surface, 1);
  cairo_ps_surface_dsc_comment(surface, ("%%Title: " + drawing.id).c_str());
}

/// The header of a PDF. Cairo 1.18 packs the words of a PDF 1.5 or later, so that nobody finds them
/// in the file without unpacking it; 1.4 has all that the figures need.
void set_pdf_words(const Drawing& drawing, cairo_surface_t* surface) {
  cairo_pdf_surface_restrict_to_version(surface, CAIRO_PDF_VERSION_1_4);
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
void draw_page(const Drawing& drawing, cairo_surface_t* surface,
               std::vector<SurfaceHandle>& images) {
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

int pixels_along(double length_pt, double dpi) {
  constexpr double kMost = 1e6, kPointsPerInch = 72.0;
  return static_cast<int>(std::lround(std::min(length_pt * dpi / kPointsPerInch, kMost)));
}

}  // namespace

void require_image_size(const Drawing& drawing) {
  constexpr int kLargestSide = 20'000;
  const int width = pixels_along(drawing.width, drawing.dpi),
            height = pixels_along(drawing.height, drawing.dpi);
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestSide)
    throw InvalidInput(
        fmt::format("figure {}: an image has 1 to {} pixels along a side, not {} x {} (--width, "
                    "--height, --dpi)",
                    drawing.id, kLargestSide, width, height));
}

Image to_image(const Drawing& drawing) {
  require_image_size(drawing);
  Image image;
  image.width = pixels_along(drawing.width, drawing.dpi);
  image.height = pixels_along(drawing.height, drawing.dpi);
  const Colour paper = drawing.background;
  const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
  image.pixels.reserve(pixels);
  prefer_huge_pages(image.pixels.data(), pixels * sizeof(image.pixels.front()));
  image.pixels.assign(pixels, paper.red << 16 | paper.green << 8 | paper.blue);
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
  const bool has_shades = std::ranges::any_of(
      drawing.items, [](const Item& item) { return std::holds_alternative<Raster>(item.what); });
  return encode_png(to_image(drawing),
                    {.dpi = drawing.dpi, .shaded = has_shades, .texts = png_words(drawing)});
}

namespace {

using CreateSurface = decltype(&cairo_pdf_surface_create_for_stream);

/// One thread at a time: Cairo asks for the local time here. The lock under which libc then sets
/// its time zone is one that ThreadSanitizer does not see.
SurfaceHandle create_surface(CreateSurface create, const Drawing& drawing, std::string& bytes) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  return SurfaceHandle(create(append_to, &bytes, drawing.width, drawing.height));
}

/// The only page of a surface that writes to a stream.
/// @param create  Of a kind of surface. @param set_words  What its file says of the drawing.
std::string page_of(const Drawing& drawing, CreateSurface create,
                    void (*set_words)(const Drawing&, cairo_surface_t*)) {
  std::string bytes;
  errno = 0;
  std::vector<SurfaceHandle> images;
  SurfaceHandle surface = create_surface(create, drawing, bytes);
  try {
    set_words(drawing, surface.get());
    draw_page(drawing, surface.get(), images);
    // Nor does it report every piece of memory that it did not get.
    if (errno == ENOMEM) throw std::bad_alloc();
  } catch (...) {
    // Cairo goes on with what failed when such a surface is closed, up to an abort. Of an image
    // that the surface refers to Cairo 1.16 makes a copy before it destroys it, and dies where it
    // has no memory for that. So all of them stay.
    static_cast<void>(surface.release());
    for (SurfaceHandle& image : images) static_cast<void>(image.release());
    throw;
  }
  surface.reset();  // Before its images.
  return bytes;
}

}  // namespace

std::string to_pdf(const Drawing& drawing) {
  return page_of(drawing, cairo_pdf_surface_create_for_stream, set_pdf_words);
}

std::string to_eps(const Drawing& drawing) {
  std::string bytes = page_of(drawing, cairo_ps_surface_create_for_stream, set_eps_words);
  // Cairo writes the time of day, which the same drawing must not depend on.
  const std::size_t date = bytes.find("%%CreationDate: ");
  if (date == std::string::npos) return bytes;
  return bytes.erase(date, bytes.find('\n', date) + 1 - date);
}

}  // namespace mapproof
