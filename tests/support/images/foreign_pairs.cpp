#include "tests/support/images/foreign_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <cairo.h>
#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "render/image/png_read.hpp"

namespace mapproof::test {
namespace {

Planting planted_word(const std::string& text, double size) {
  constexpr int kWidth = 64, kHeight = 24;
  Planting planting{fmt::format("\"{}\" at {:.0f} px", text, size), kWidth, kHeight, {}};
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, kWidth, kHeight);
  cairo_t* context = cairo_create(surface);
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size);
  cairo_move_to(context, 2.0, 17.0);
  cairo_show_text(context, text.c_str());
  cairo_destroy(context);
  cairo_surface_flush(surface);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) planting.cover.push_back(data[y * stride + x]);
  cairo_surface_destroy(surface);
  return planting;
}

Planting planted_disc(double radius) {
  const int side = 2 * static_cast<int>(std::ceil(radius)) + 1;
  Planting planting{fmt::format("a disc of radius {:.1f}", radius), side, side, {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      planting.cover.push_back(static_cast<int>(
          255 * std::clamp(radius + 0.5 - std::hypot(x - side / 2, y - side / 2), 0.0, 1.0)));
  return planting;
}

Planting planted_block(int width, int height) {
  return {fmt::format("{} x {} pixels", width, height), width, height,
          std::vector<int>(static_cast<std::size_t>(width) * height, 255)};
}

Planting planted_line(int length) {
  Planting planting{fmt::format("a line of {} px", length), length, length / 3 + 2, {}};
  planting.cover.assign(static_cast<std::size_t>(planting.width) * planting.height, 0);
  for (int x = 0; x < length; ++x) {
    const double y = x / 3.0;
    const auto cell = static_cast<std::size_t>(std::floor(y)) * length + x;
    planting.cover[cell] = static_cast<int>(255 * (1.0 - (y - std::floor(y))));
    planting.cover[cell + length] = 255 - planting.cover[cell];
  }
  return planting;
}

int channel(std::uint32_t pixel, int c) { return static_cast<int>((pixel >> (8 * c)) & 0xFF); }

/// Whether no channel varies by more than two levels in the box.
bool is_flat(const Image& image, const PixelBox& box) {
  const std::uint32_t first = image.row(box.y)[box.x];
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x)
      for (int c = 0; c < 3; ++c)
        if (std::abs(channel(image.row(y)[x], c) - channel(first, c)) > 2) return false;
  return true;
}

/// The largest number of connected pixels of the planting that are at least so far from the ground.
int connected_pixels(const Planting& planting, int contrast, int least) {
  std::vector<bool> is_in;
  for (const int cover : planting.cover) is_in.push_back(contrast * cover / 255 >= least);
  int largest = 0;
  for (int start = 0; start < static_cast<int>(is_in.size()); ++start) {
    if (!is_in[start]) continue;
    std::vector<int> group{start};
    is_in[start] = false;
    for (std::size_t next = 0; next < group.size(); ++next)
      for (int step = 0; step < 9; ++step) {
        const int x = group[next] % planting.width + step % 3 - 1;
        const int y = group[next] / planting.width + step / 3 - 1;
        if (x < 0 || y < 0 || x >= planting.width || y >= planting.height) continue;
        const int cell = y * planting.width + x;
        if (is_in[cell]) group.push_back(cell);
        is_in[cell] = false;
      }
    largest = std::max(largest, static_cast<int>(group.size()));
  }
  return largest;
}

}  // namespace

std::vector<HarmlessPair> harmless_pairs() {
  std::map<std::string, std::vector<Image>> variants;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(MAPPROOF_TEST_DATA) / "foreign_images"))
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& file : files)
    variants[file.stem().stem()].push_back(read_png(read_file(file)).image);
  std::vector<HarmlessPair> pairs;
  for (const auto& [plot, images] : variants)
    for (std::size_t i = 0; i < images.size(); ++i)
      for (std::size_t j = 0; j < images.size(); ++j)
        if (i != j) pairs.push_back({plot, images[i], images[j]});
  return pairs;
}

Planting random_planting(Random& random) {
  const auto one_of = [&](int n) { return static_cast<int>(random.uniform(0.0, n)); };
  switch (one_of(5)) {
    case 0:
      return planted_word(
          std::vector<std::string>{"no", "new", "old", "WARNING", "x", "ok?"}[one_of(6)],
          random.uniform(7.0, 14.0));
    case 1:
      return planted_word(std::to_string(one_of(100)), random.uniform(7.0, 14.0));
    case 2:
      return planted_disc(random.uniform(1.0, 5.0));
    case 3:
      return planted_line(6 + one_of(40));
    default:
      return planted_block(2 + one_of(6), 2 + one_of(6));
  }
}

PixelBox flat_place(const HarmlessPair& pair, const Planting& planting, Random& random) {
  constexpr int kMargin = 3;
  for (int attempt = 0; attempt < 200; ++attempt) {
    const PixelBox box{
        static_cast<int>(random.uniform(0.0, pair.baseline.width - planting.width - 2.0 * kMargin)),
        static_cast<int>(
            random.uniform(0.0, pair.baseline.height - planting.height - 2.0 * kMargin)),
        planting.width + 2 * kMargin, planting.height + 2 * kMargin};
    if (box.x < 0 || box.y < 0) return {};
    if (is_flat(pair.baseline, box) && is_flat(pair.current, box))
      return {box.x + kMargin, box.y + kMargin, planting.width, planting.height};
  }
  return {};
}

Image planted(Image image, const Planting& planting, const PixelBox& place, int contrast) {
  for (int y = 0; y < planting.height; ++y)
    for (int x = 0; x < planting.width; ++x) {
      std::uint32_t& pixel = image.row(place.y + y)[place.x + x];
      std::uint32_t colour = 0;
      for (int c = 0; c < 3; ++c) {
        const int ground = channel(pixel, c), to = ground >= 128 ? -contrast : contrast;
        const int value = std::clamp(ground + to * planting.at(x, y) / 255, 0, 255);
        colour |= static_cast<std::uint32_t>(value) << (8 * c);
      }
      pixel = colour;
    }
  return image;
}

bool is_promised(const Planting& planting, int contrast) {
  return connected_pixels(planting, contrast, 24) >= 4 ||
         connected_pixels(planting, contrast, 12) >= 20;
}

}  // namespace mapproof::test
