#include "render/output/write_scene.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/files/output_folder.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/export/figure_csv.hpp"
#include "render/export/figure_script.hpp"
#include "render/image/image.hpp"
#include "render/output/write_drawn.hpp"
#include "render/plot/layout.hpp"
#include "render/scene/scene_figure.hpp"
#include "render/scene/scene_json.hpp"
#include "render/svg/svg.hpp"

namespace mapproof {
namespace {

/// An image of half the size, each pixel the rounded mean of four; the last row or column of an odd
/// size is dropped.
Image halved(const Image& image) {
  Image half{image.width / 2, image.height / 2, {}};
  half.pixels.reserve(static_cast<std::size_t>(half.width) * half.height);
  for (int y = 0; y < half.height; ++y) {
    const std::uint32_t* above = image.row(2 * y);
    const std::uint32_t* below = image.row(2 * y + 1);
    for (int x = 0; x < half.width; ++x) {
      std::uint32_t pixel = 0;
      for (const int shift : {0, 8, 16}) {
        std::uint32_t sum = 2;
        for (const std::uint32_t p :
             {above[2 * x], above[2 * x + 1], below[2 * x], below[2 * x + 1]})
          sum += p >> shift & 0xFF;
        pixel |= sum / 4 << shift;
      }
      half.pixels.push_back(pixel);
    }
  }
  return half;
}

constexpr int kSamples = 4;

struct PixelSize {
  int width = 0, height = 0;
};

/// The place moved to whole pixels, so that none is drawn twice.
Box on_pixels(const Box& position, double per_point) {
  const auto whole = [per_point](double at) { return std::round(at * per_point) / per_point; };
  return {whole(position.x0), whole(position.y0), whole(position.x1), whole(position.y1)};
}

PixelSize pixels_of(const Box& box, double per_point) {
  return {static_cast<int>(std::lround(box.width() * per_point)),
          static_cast<int>(std::lround(box.height() * per_point))};
}

bool shows_pixels(FileFormat format) {
  return format != FileFormat::kJson && format != FileFormat::kCsv &&
         format != FileFormat::kMatplotlib;
}

/// A scene laid out, the sizes of its images checked as SceneClient::require_size() does.
Drawing checked_layout(const Scene& scene, const Theme& theme) {
  Drawing drawing = lay_out(scene_figure(scene, theme), theme);
  const double per_point = theme.dpi / 72.0;
  for (const Item& item : drawing.items)
    if (const auto* raster = std::get_if<Raster>(&item.what)) {
      const auto [width, height] = pixels_of(on_pixels(raster->position, per_point), per_point);
      SceneClient::require_size(scene, width, height);
    }
  return drawing;
}

/// How much finer the poster is; 1 where it would be larger than an image can be.
int poster_scale(const Drawing& drawing) {
  const double longest = std::max(drawing.width, drawing.height) * drawing.dpi / 72.0;
  return 2.0 * longest <= SceneClient::kLargestSide ? 2 : 1;
}

Drawing with_dark_images(Drawing drawing, const Scene& scene, const Theme& dark,
                         SceneClient& client) {
  for (Item& item : drawing.items)
    if (auto* raster = std::get_if<Raster>(&item.what))
      raster->dark = std::make_shared<Image>(
          client.draw(scene, scene_request(raster->source, raster->image->width,
                                           raster->image->height, kSamples, dark)));
  return drawing;
}

}  // namespace

void write_animation(const Film& film, const Theme& theme, const OutputFolder& folder,
                     SceneClient& client, const AnimationJob& job) {
  std::vector<Image> frames;
  AnimationOptions options;
  for (const Scene& scene : film.frames) {
    Drawing drawing = draw_scene(scene, theme, client).screen;
    frames.push_back(to_image(drawing));
    if (frames.size() == 1)
      require_animation_size(frames[0].width, frames[0].height, film.frames.size());
    drawing.id = film.id;
    options.texts = png_words(drawing);
    if (job.drawn) job.drawn(frames.size());
  }
  for (const AnimationFormat format : job.formats) {
    options.format = format;
    folder.write(fmt::format("{}.{}", film.id, name(format)), encode_animation(frames, options));
  }
}

void require_scene_size(const Scene& scene, const Theme& theme, const FileFormats& formats) {
  if (std::ranges::any_of(formats, shows_pixels)) checked_layout(scene, theme);
}

void require_film_size(const Film& film, const Theme& theme) {
  Drawing first;
  if (!film.frames.empty()) first = checked_layout(film.frames.front(), theme);
  const auto [width, height] = pixels_of({0.0, 0.0, first.width, first.height}, theme.dpi / 72.0);
  require_animation_size(width, height, film.frames.size());
}

SceneDrawing draw_scene(const Scene& scene, const Theme& theme, SceneClient& client,
                        const Theme* dark) {
  SceneDrawing drawn;
  drawn.screen = lay_out(scene_figure(scene, theme), theme);
  drawn.poster = drawn.screen;
  const int scale = poster_scale(drawn.screen);
  drawn.poster.dpi = scale * theme.dpi;
  const double per_point = theme.dpi / 72.0;
  for (std::size_t i = 0; i < drawn.screen.items.size(); ++i) {
    auto* screen = std::get_if<Raster>(&drawn.screen.items[i].what);
    if (screen == nullptr) continue;
    auto* poster = std::get_if<Raster>(&drawn.poster.items[i].what);
    screen->position = poster->position = on_pixels(screen->position, per_point);
    const auto [width, height] = pixels_of(screen->position, per_point);
    auto fine = std::make_shared<Image>(client.draw(
        scene, scene_request(screen->source, scale * width, scale * height, kSamples, theme)));
    screen->image = scale == 1 ? fine : std::make_shared<Image>(halved(*fine));
    poster->image = std::move(fine);
  }
  drawn.screen.renderer = drawn.poster.renderer = client.renderer();
  if (dark != nullptr) drawn.page = with_dark_images(drawn.screen, scene, *dark, client);
  return drawn;
}

std::string write_scene(const Scene& scene, const Theme& theme, const OutputFolder& folder,
                        SceneClient& client, const FileFormats& formats, const Theme* dark) {
  const bool has_pixels = std::ranges::any_of(formats, shows_pixels);
  const SceneDrawing drawn = has_pixels ? draw_scene(scene, theme, client, dark) : SceneDrawing{};
  std::string svg;
  for (const FileFormat format : formats) {
    switch (format) {
      case FileFormat::kSvg:
        svg = to_svg(drawn.screen);
        folder.write(scene.id + ".svg", svg);
        if (drawn.page) svg = to_svg(*drawn.page);
        break;
      case FileFormat::kPng:
        write_drawn(folder, scene.id + ".png", [&] { return to_png(drawn.poster); });
        break;
      case FileFormat::kPdf:
        write_drawn(folder, scene.id + ".pdf", [&] { return to_pdf(drawn.poster); });
        break;
      case FileFormat::kEps:
        write_drawn(folder, scene.id + ".eps", [&] { return to_eps(drawn.poster); });
        break;
      case FileFormat::kJson:
        folder.write(scene.id + ".scene.json", scene_to_json(scene));
        break;
      case FileFormat::kCsv:
        folder.write(scene.id + ".csv", scene_csv(scene));
        break;
      case FileFormat::kMatplotlib:
        folder.write(scene.id + ".py", scene_script(scene, theme));
        break;
    }
  }
  return svg;
}

}  // namespace mapproof
