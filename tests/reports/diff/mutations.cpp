#include "tests/reports/diff/mutations.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/images/baselines.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

std::uint8_t moved(std::uint8_t value, int by) {
  return static_cast<std::uint8_t>(value + by < 0 || value + by > 255 ? value - by : value + by);
}

Colour subtle(Colour from, int by) {
  return {moved(from.red, by), moved(from.green, -by), moved(from.blue, by)};
}

/// Adds -1, 0 or 1 to every channel that has room for it.
Image noisy(Image image, std::uint64_t seed) {
  Random random(seed);
  for (std::uint32_t& pixel : image.pixels)
    for (const int shift : {16, 8, 0}) {
      const int value = static_cast<int>((pixel >> shift) & 0xFF);
      const int other = std::clamp(value + static_cast<int>(3.0 * random.uniform()) - 1, 0, 255);
      pixel = (pixel & ~(0xFFu << shift)) | static_cast<std::uint32_t>(other) << shift;
    }
  return image;
}

Image shifted(const Image& image, int right, int down) {
  Image moved_image = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      moved_image.row(y)[x] = image.row(
          std::clamp(y - down, 0, image.height - 1))[std::clamp(x - right, 0, image.width - 1)];
  return moved_image;
}

Image tinted(Image image, std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t& pixel : image.pixels)
    if (pixel == from) pixel = to;
  return image;
}

class Mutations {
 public:
  Mutations(const Drawing& drawing, std::string image)
      : drawing_(std::make_shared<Drawing>(drawing)), image_(std::move(image)) {}

  std::vector<Mutation> all() {
    harmless();
    whole_page();
    marks();
    lines();
    words();
    return std::move(found_);
  }

 private:
  void add(std::string name, ImageState expected, std::function<Image()> current) {
    found_.push_back({std::move(name), image_, expected,
                      [drawing = drawing_] { return drawn(*drawing); }, std::move(current)});
  }
  void style(std::string name, const Style& style) {
    add(std::move(name), ImageState::kWithinTolerance,
        [drawing = drawing_, style] { return drawn(*drawing, style); });
  }
  void text(std::string name, Style style) {
    style.outlined = false;
    found_.push_back({std::move(name), image_, ImageState::kWithinTolerance,
                      [drawing = drawing_] { return drawn(*drawing, {.outlined = false}); },
                      [drawing = drawing_, style] { return drawn(*drawing, style); }});
  }
  void change(std::string name, ImageState expected, const Change& change) {
    add(std::move(name), expected, [drawing = drawing_, change] {
      Drawing other = *drawing;
      change(other);
      return drawn(other);
    });
  }
  /// Of the items of a class, the first, a middle one and the last.
  std::vector<std::size_t> some(const std::function<bool(const Item&)>& wanted) const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < drawing_->items.size(); ++i)
      if (wanted(drawing_->items[i])) all.push_back(i);
    if (all.size() <= 3) return all;
    return {all.front(), all[all.size() / 2], all.back()};
  }

  /// Whether strokes are thinner than a pixel: without anti-aliasing they may vanish.
  bool has_hairlines() const {
    return std::ranges::any_of(drawing_->items, [this](const Item& item) {
      const auto* shape = std::get_if<Shape>(&item.what);
      return shape && shape->stroke && shape->stroke->width * drawing_->dpi / 72.0 < 0.99;
    });
  }

  void harmless() {
    add("the same", ImageState::kIdentical, [drawing = drawing_] { return drawn(*drawing); });
    for (const std::uint64_t seed : {1, 2})
      add("noise", ImageState::kWithinTolerance,
          [drawing = drawing_, seed] { return noisy(drawn(*drawing), seed); });
    found_.push_back({"noise on both", image_, ImageState::kWithinTolerance,
                      [drawing = drawing_] { return noisy(drawn(*drawing), 3); },
                      [drawing = drawing_] { return noisy(drawn(*drawing), 4); }});
    style("moved 0.1 px right", {.right_px = 0.1});
    style("moved 0.1 px down", {.down_px = 0.1});
    style("moved 0.1 px up and left", {.right_px = -0.07, .down_px = -0.07});
    if (!has_hairlines()) style("shapes not smoothed", {.shapes = CAIRO_ANTIALIAS_NONE});
    style("shapes smoothed fast", {.shapes = CAIRO_ANTIALIAS_FAST});
    style("shapes smoothed best", {.shapes = CAIRO_ANTIALIAS_BEST});
    text("hinted slightly", {.hinting = CAIRO_HINT_STYLE_SLIGHT});
    text("hinted medium", {.hinting = CAIRO_HINT_STYLE_MEDIUM});
    text("hinted fully", {.hinting = CAIRO_HINT_STYLE_FULL});
    text("text not smoothed", {.text = CAIRO_ANTIALIAS_NONE});
    text("text smoothed in subpixels", {.text = CAIRO_ANTIALIAS_SUBPIXEL});
    if (!has_hairlines())
      text("nothing smoothed", {.shapes = CAIRO_ANTIALIAS_NONE, .text = CAIRO_ANTIALIAS_NONE});
    text("text not smoothed but hinted",
         {.text = CAIRO_ANTIALIAS_NONE, .hinting = CAIRO_HINT_STYLE_FULL});
  }

  void whole_page() {
    using enum ImageState;
    for (const auto& [right, down] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {1, 1}})
      add(fmt::format("all moved {} {} px", right, down), kDifferent,
          [drawing = drawing_, right = right, down = down] {
            return shifted(drawn(*drawing), right, down);
          });
    const Colour paper = drawing_->background;
    const auto from = static_cast<std::uint32_t>(paper.red << 16 | paper.green << 8 | paper.blue);
    for (const std::uint32_t to : {from - 1, from - 0x010101, from - 0x000200, from - 0x020205})
      add(fmt::format("background {:06x}", to), kDifferent,
          [drawing = drawing_, from, to] { return tinted(drawn(*drawing), from, to); });
    add("background one level darker, with noise", kDifferent, [drawing = drawing_, from] {
      return noisy(tinted(drawn(*drawing), from, from - 0x020202), 5);
    });
    change("background by the theme", kDifferent, [paper](Drawing& drawing) {
      drawing.background = {moved(paper.red, -3), moved(paper.green, -3), moved(paper.blue, -6)};
    });
  }

  void marks() {
    using enum ImageState;
    const auto wanted = [](const Item& item) {
      return item.item_class == ItemClass::kMarker && std::holds_alternative<Stamp>(item.what);
    };
    const double px = 72.0 / drawing_->dpi;
    for (const std::size_t i : some(wanted)) {
      change(fmt::format("marker {} lost", i), kDifferent,
             [i](Drawing& drawing) { drawing.items.erase(drawing.items.begin() + i); });
      const auto move = [i](double right, double down) {
        return [=](Drawing& drawing) {
          Point& at = std::get<Stamp>(drawing.items[i].what).at;
          at = {at.x + right, at.y + down};
        };
      };
      change(fmt::format("marker {} moved 1 px right", i), kDifferent, move(px, 0));
      change(fmt::format("marker {} moved 1 px up", i), kDifferent, move(0, -px));
      change(fmt::format("marker {} moved 0.1 px", i), kWithinTolerance, move(0.1 * px, 0));
      change(fmt::format("marker {} of another colour", i), kDifferent, [i](Drawing& drawing) {
        auto& stamp = std::get<Stamp>(drawing.items[i].what);
        Shape symbol = drawing.symbols[stamp.symbol];
        if (symbol.fill) symbol.fill = subtle(*symbol.fill, 12);
        if (symbol.stroke) symbol.stroke->colour = subtle(symbol.stroke->colour, 12);
        drawing.symbols.push_back(symbol);
        stamp.symbol = drawing.symbols.size() - 1;
      });
    }
  }

  /// Strokes of a colour: one series.
  std::map<Colour, int> stroke_colours() const {
    std::map<Colour, int> colours;
    for (const Item& item : drawing_->items)
      if (const auto* shape = std::get_if<Shape>(&item.what);
          shape && shape->stroke && item.item_class == ItemClass::kLine)
        ++colours[shape->stroke->colour];
    return colours;
  }

  void lines() {
    using enum ImageState;
    const auto is_shape = [](const Item& item) { return std::holds_alternative<Shape>(item.what); };
    for (const std::size_t i : some([&](const Item& item) {
           return is_shape(item) &&
                  (item.item_class == ItemClass::kLine || item.item_class == ItemClass::kGrid ||
                   item.item_class == ItemClass::kBand);
         })) {
      const std::string item_class(name(drawing_->items[i].item_class));
      change(fmt::format("{} {} lost", item_class, i), kDifferent,
             [i](Drawing& drawing) { drawing.items.erase(drawing.items.begin() + i); });
    }
    for (const auto& [colour, count] : stroke_colours())
      for (const int by : {6, 12})
        change(fmt::format("curve {} {} levels off", hex(colour), by), kDifferent,
               [colour = colour, by](Drawing& drawing) {
                 for (Item& item : drawing.items)
                   if (auto* shape = std::get_if<Shape>(&item.what);
                       shape && shape->stroke && shape->stroke->colour == colour)
                     shape->stroke->colour = subtle(colour, by);
               });
    for (const std::size_t i : some([&](const Item& item) {
           return is_shape(item) && item.item_class == ItemClass::kBand &&
                  std::get<Shape>(item.what).fill;
         }))
      for (const double by : {0.9, 1.1, 0.5})
        change(fmt::format("band {} {} times as opaque", i, by), kDifferent,
               [i, by](Drawing& drawing) {
                 std::get<Shape>(drawing.items[i].what).fill_opacity *= by;
               });
    const auto is_grid = [](const Item& item) { return item.item_class == ItemClass::kGrid; };
    if (!some(is_grid).empty())
      change("grid lost", kDifferent,
             [is_grid](Drawing& drawing) { std::erase_if(drawing.items, is_grid); });
  }

  void words() {
    using enum ImageState;
    for (const std::size_t i : some([](const Item& item) {
           return item.item_class == ItemClass::kTickLabel &&
                  std::holds_alternative<TextLine>(item.what);
         }))
      for (const int by : {1, 3, 6}) {
        const std::string& text = std::get<TextLine>(drawing_->items[i].what).shaped.text;
        const std::size_t digit = text.find_last_of("0123456789");
        if (digit == std::string::npos) continue;
        std::string other = text;
        other[digit] = static_cast<char>('0' + (text[digit] - '0' + by) % 10);
        change(fmt::format("tick {} became {}", text, other), kDifferent, [=](Drawing& drawing) {
          std::get<TextLine>(drawing.items[i].what).shaped = shape_text(other);
        });
      }
    const auto legend = some([](const Item& item) {
      return item.item_class == ItemClass::kLegendText &&
             std::holds_alternative<TextLine>(item.what);
    });
    if (legend.size() < 2) return;
    change("legend order swapped", kDifferent, [legend](Drawing& drawing) {
      std::swap(std::get<TextLine>(drawing.items[legend[0]].what).shaped,
                std::get<TextLine>(drawing.items[legend[1]].what).shaped);
    });
    change("legend entry lost", kDifferent,
           [legend](Drawing& drawing) { drawing.items.erase(drawing.items.begin() + legend[1]); });
  }

  std::shared_ptr<Drawing> drawing_;
  std::string image_;
  std::vector<Mutation> found_;
};

/// The defaults of many programs: 72 dpi, lines of one pixel, small text.
Theme plain_theme() {
  Theme theme = report_theme();
  theme.name = "plain";
  theme.dpi = 72.0;
  return theme;
}

Theme pale_theme() {
  Theme theme = baseline_theme();
  theme.name = "pale";
  theme.grid = colour(0xF8F8F8);
  return theme;
}

}  // namespace

std::vector<Mutation> mutations_of(const Drawing& drawing, const std::string& image) {
  return Mutations(drawing, image).all();
}

std::vector<std::pair<std::string, Drawing>> mutable_drawings() {
  std::vector<std::pair<std::string, Drawing>> drawings;
  const auto draw = [&](const Figure& figure, const Theme& theme) {
    drawings.emplace_back(figure.id + " " + theme.name, lay_out(figure, theme));
  };
  for (const Figure& figure : sample_figures()) {
    for (const char* id : {"map-usual", "curve-usual", "curve-filled", "path-usual",
                           "parameter-usual", "shepard-usual", "measurement-bearing"})
      if (figure.id == id)
        for (const Theme& theme : {baseline_theme(), plain_theme(), pale_theme()})
          draw(figure, theme);
    if (figure.id == "curve-usual") draw(figure, report_theme());
    if (figure.id == "map-usual") draw(figure, paper_theme(3.25));
  }
  return drawings;
}

}  // namespace mapproof::test
