#include <algorithm>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <libdeflate.h>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "render/image/png_read.hpp"
#include "tests/reports/diff/small_study.hpp"
#include "tests/reports/diff/value_cases.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(libdeflate_crc32(0, body.data(), body.size()));
}

/// As RGB without filters, hardly compressed: the same pixels in other bytes.
std::string plain_png(const Image& image) {
  std::string rows;
  for (int y = 0; y < image.height; ++y) {
    rows += '\0';
    for (int x = 0; x < image.width; ++x) {
      const std::uint32_t pixel = image.row(y)[x];
      rows +=
          {static_cast<char>(pixel >> 16), static_cast<char>(pixel >> 8), static_cast<char>(pixel)};
    }
  }
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(1), libdeflate_free_compressor);
  std::string packed(libdeflate_zlib_compress_bound(compressor.get(), rows.size()), '\0');
  packed.resize(libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), packed.data(),
                                         packed.size()));
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(static_cast<std::uint32_t>(image.width)) +
                           big_endian(static_cast<std::uint32_t>(image.height)) +
                           std::string("\x08\x02\x00\x00\x00", 5)) +
         chunk("IDAT", packed) + chunk("IEND", "");
}

struct Drawing {
  std::string id;
  std::vector<ValueCase>& cases;

  void add(const std::string& what, Verdict verdict, bool passes, std::vector<std::string> cause,
           const std::function<void(const fs::path&)>& change) const {
    cases.push_back({.name = id + ": " + what,
                     .id = id,
                     .verdict = verdict,
                     .cause = std::move(cause),
                     .passes = passes,
                     .change = change,
                     .alone = true});
  }

  /// Changes the pixels of its PNG.
  void add_pixels(const std::string& what, bool passes,
                  const std::function<void(Image&)>& change) const {
    add(what, Verdict::kRenderer, passes, {"the figure's value is equal", "png"},
        [id = id, change](const fs::path& folder) {
          const fs::path file = folder / "figures" / (id + ".png");
          Image image = read_png(read_file(file)).image;
          change(image);
          write_file(file, plain_png(image));
        });
  }

  /// Changes the text of its SVG.
  void add_text(const std::string& what, Verdict verdict, std::vector<std::string> cause,
                const std::string& from, const std::string& to) const {
    const bool passes = verdict == Verdict::kIdentical;
    add(what, verdict, passes, std::move(cause), [=, id = id](const fs::path& folder) {
      const fs::path file = folder / "figures" / (id + ".svg");
      std::string text = read_file(file);
      const std::size_t at = text.find(from);
      if (at == std::string::npos) throw std::runtime_error("nothing to change: " + from);
      write_file(file, text.replace(at, from.size(), to));
    });
  }
};

void add_pixels(const Drawing& drawing) {
  const std::string id = drawing.id;
  drawing.add("PNG compressed otherwise", Verdict::kIdentical, true, {},
              [id](const fs::path& folder) {
                const fs::path file = folder / "figures" / (id + ".png");
                write_file(file, plain_png(read_png(read_file(file)).image));
              });
  drawing.add("metadata of the PNG", Verdict::kIdentical, true, {}, [id](const fs::path& folder) {
    const fs::path file = folder / "figures" / (id + ".png");
    std::string bytes = read_file(file);
    bytes.insert(33, chunk("tEXt", std::string("Comment\0made elsewhere", 22)));
    write_file(file, bytes);
  });
  drawing.add_pixels("noise of one level", true, [](Image& image) {
    Random random(3);
    for (std::uint32_t& pixel : image.pixels)
      for (const int shift : {0, 8, 16}) {
        const std::uint32_t level = pixel >> shift & 255U;
        if (level > 0 && random.uniform() < 0.3) pixel -= 1U << shift;
      }
  });
  for (const int by : {1, 2})
    drawing.add_pixels(fmt::format("shifted by {} px", by), false, [by](Image& image) {
      for (int y = 0; y < image.height; ++y)
        std::rotate(image.row(y), image.row(y) + image.width - by, image.row(y) + image.width);
    });
  for (const std::uint32_t tint : {0xFFF8E7U, 0xFAFAFFU})
    drawing.add_pixels(fmt::format("background {:x}", tint), false, [tint](Image& image) {
      for (std::uint32_t& pixel : image.pixels)
        if ((pixel & 0xFFFFFFU) == 0xFFFFFFU) pixel = tint;
    });
  drawing.add_pixels("a part lost", false, [](Image& image) {
    const int y0 = image.height / 2, x0 = image.width / 2;
    for (int y = y0; y < y0 + 60; ++y)
      for (int x = x0 - 150; x < x0 + 150; ++x) image.row(y)[x] = 0xFFFFFFU;
  });
}

void add_svg(const Drawing& drawing) {
  drawing.add_text("comment in the SVG", Verdict::kIdentical, {}, "<svg ",
                   "<!-- made elsewhere --><svg ");
  drawing.add_text("a colour of the SVG", Verdict::kStyle, {"its styles differ"}, "stroke=\"#",
                   "stroke=\"#7f00ff\" data-was=\"#");
  const std::string mark = drawing.id.starts_with("map") ? " data-kind=\"" : " data-curve=\"";
  drawing.add_text("a mark of the SVG moved", Verdict::kChanged,
                   {"the figure's value is equal, its svg does not show it"}, mark,
                   " transform=\"translate(3 0)\"" + mark);
  drawing.add_text("a text of the SVG", Verdict::kStyle, {"its styles differ"}, "aria-label=\"0",
                   "aria-label=\"7");
}

/// The same figure in another theme.
void add_themes(const Drawing& drawing, const Figure& figure) {
  const auto themed = [&](const std::string& what, const std::function<void(Theme&)>& change) {
    drawing.add(what, Verdict::kStyle, false, {"the figure's value is equal", "its styles differ"},
                [figure, change](const fs::path& folder) {
                  Theme theme = report_theme();
                  change(theme);
                  write_study_figure(figure, theme, folder);
                });
  };
  themed("font", [](Theme& t) { t.font_pt += 1.0; });
  themed("tick font", [](Theme& t) { t.tick_font_pt -= 1.0; });
  themed("title font", [](Theme& t) { t.title_font_pt += 2.0; });
  themed("line width", [](Theme& t) { t.line_pt *= 1.4; });
  themed("marker size", [](Theme& t) { t.marker_pt *= 1.2; });
  themed("grid lost", [](Theme& t) { t.grid = t.background; });
  themed("grid colour", [](Theme& t) { t.grid = colour(0xBBBBDD); });
  themed("background", [](Theme& t) { t.background = colour(0xFFFDF0); });
  themed("colour of a series", [](Theme& t) { t.series[0] = colour(0x006EAE); });
  themed("text colour", [](Theme& t) { t.text = colour(0x333333); });
  themed("page", [](Theme& t) { t.width_pt += 10.0; });
}

}  // namespace

std::vector<ValueCase> drawing_cases() {
  std::vector<ValueCase> cases;
  for (const Figure& figure : SmallStudy().figures()) {
    const Drawing drawing{figure.id, cases};
    add_pixels(drawing);
    add_svg(drawing);
    add_themes(drawing, figure);
  }
  return cases;
}

}  // namespace mapproof::test
