#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <png.h>
#include <tbb/parallel_for.h>

#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/random.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/image/png.hpp"
#include "render/plot/layout.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "tests/support/images/foreign_pairs.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// As most programs write PNG: RGB and alpha, libpng's filters, zlib at its usual level.
void write_usual_png(const fs::path& path, const Image& image) {
  std::vector<unsigned char> bytes;
  for (const std::uint32_t pixel : image.pixels)
    for (const std::uint32_t value : {pixel >> 16, pixel >> 8, pixel, 0xFFu})
      bytes.push_back(static_cast<unsigned char>(value));
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGBA;
  make_folder(path.parent_path());
  if (!png_image_write_to_file(&header, path.c_str(), 0, bytes.data(), 0, nullptr))
    throw std::runtime_error(header.message);
}

/// A figure on a page of this size, cut off where it is longer.
Image drawn(const Figure& figure, int width, int height) {
  Theme theme = report_theme();
  theme.dpi = 72.0 * width / theme.width_pt;
  theme.height_pt = theme.width_pt * height / width;
  const Image whole = to_image(lay_out(figure, theme));
  Image page{width, height, std::vector<std::uint32_t>(std::size_t(width) * height, 0xFFFFFF)};
  for (int y = 0; y < std::min(height, whole.height); ++y)
    std::copy_n(whole.row(y), std::min(width, whole.width), page.row(y));
  return page;
}

/// Blocks of another colour on about a thousandth of the pixels.
Image with_changes(Image image) {
  const int side = std::max(4, static_cast<int>(image.width * 0.012));
  for (int block = 0; block < 7; ++block)
    for (int y = 0; y < side; ++y)
      std::fill_n(image.row((2 * block + 1) * image.height / 16 + y) +
                      (3 * block + 1) % 8 * image.width / 9,
                  side, 0xC04020u);
  return image;
}

void write_pair(const fs::path& folder, const std::string& name, const Image& image,
                bool is_changed) {
  write_usual_png(folder / "a" / name, image);
  write_usual_png(folder / "b" / name, is_changed ? with_changes(image) : image);
}

void make(const fs::path& folder) {
  const std::vector<Figure> figures = test::sample_figures();
  const auto figure = std::ranges::find(figures, "path-usual", &Figure::id);
  write_pair(folder / "one", "p.png", drawn(*figure, 1600, 1200), true);
  write_pair(folder / "large", "p.png", drawn(*figure, 7680, 4320), true);
  for (int i = 0; i < 100; ++i) {
    const Image image = drawn(figures[i % figures.size()], 1200, 900);
    const std::string name = fmt::format("{:03}.png", i);
    write_pair(folder / "mostly", name, image, i % 20 == 0);
    write_pair(folder / "changed", name, image, true);
  }
}

/// One level up or down at random places, as other rounding leaves it.
Image with_noise(Image image, Random& random) {
  for (std::uint32_t& pixel : image.pixels) {
    const double which = random.uniform();
    const std::uint32_t green = (pixel >> 8) & 0xFF;
    if (which < 0.2 && green > 0) pixel -= 0x100;
    if (which > 0.8 && green < 255) pixel += 0x100;
  }
  return image;
}

/// Pairs in which programs err: same-NNN.png, which no reader can tell apart, and changed-NNN.png,
/// which differ in the same harmless way, and in one of them something is drawn on flat ground.
void make_errors(const fs::path& folder) {
  constexpr std::size_t kChanged = 200;
  const std::vector<test::HarmlessPair> pairs = test::harmless_pairs();
  Random random(22);
  std::size_t same = 0, changed = 0;
  const auto write = [&](const std::string& name, const Image& a, const Image& b) {
    write_usual_png(folder / "a" / name, a);
    write_usual_png(folder / "b" / name, b);
  };
  for (const test::HarmlessPair& pair : pairs) {
    write(fmt::format("same-{:03}.png", same++), pair.baseline, pair.current);
    write(fmt::format("same-{:03}.png", same++), pair.baseline, with_noise(pair.baseline, random));
  }
  for (std::size_t round = 0; changed < kChanged; ++round) {
    const test::HarmlessPair& pair = pairs[round % pairs.size()];
    const test::Planting planting = test::random_planting(random);
    const int contrast = static_cast<int>(random.uniform(12.0, 120.0));
    const PixelBox place = test::flat_place(pair, planting, random);
    if (place.width == 0 || !test::is_promised(planting, contrast)) continue;
    write(fmt::format("changed-{:03}.png", changed++), pair.baseline,
          test::planted(pair.current, planting, place, contrast));
  }
}

void compare(const fs::path& baseline, const fs::path& current, const fs::path& heat) {
  HeatMap map;
  const ImageDiff diff = image_diff(baseline, current, {}, &map);
  if (diff.state == ImageState::kDifferent && map.width > 0)
    write_file(heat, encode_png(std::move(map)));
}

void compare_folders(const fs::path& baseline, const fs::path& current, const fs::path& heat) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(baseline))
    names.push_back(entry.path().filename());
  tbb::parallel_for(std::size_t{0}, names.size(), [&](std::size_t i) {
    compare(baseline / names[i], current / names[i], heat / names[i]);
  });
}

}  // namespace
}  // namespace mapproof

/// Makes the pairs that scripts/bench diff compares, or compares all images of two folders and
/// writes the heat maps of those that differ.
int main(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "make" && argc == 3) {
    mapproof::make(argv[2]);
  } else if (command == "errors" && argc == 3) {
    mapproof::make_errors(argv[2]);
  } else if (command == "compare" && argc == 5) {
    mapproof::compare_folders(argv[2], argv[3], argv[4]);
  } else {
    std::fputs(
        "usage: diff_bench make FOLDER | errors FOLDER | compare BASELINE CURRENT HEAT_MAPS\n",
        stderr);
    return 2;
  }
}
