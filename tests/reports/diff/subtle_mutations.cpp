#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "tests/reports/diff/mutations.hpp"

namespace mapproof::test {
namespace {

/// The stroke of a line of data, or null.
Stroke* stroke_of(Item& item) {
  auto* shape = std::get_if<Shape>(&item.what);
  return shape && shape->stroke && item.item_class == ItemClass::kLine ? &*shape->stroke : nullptr;
}

std::set<Colour> line_colours(Drawing drawing) {
  std::set<Colour> colours;
  for (Item& item : drawing.items)
    if (const Stroke* stroke = stroke_of(item)) colours.insert(stroke->colour);
  return colours;
}

Change thicker(Colour colour, double times) {
  return [=](Drawing& drawing) {
    for (Item& item : drawing.items)
      if (Stroke* stroke = stroke_of(item); stroke && stroke->colour == colour)
        stroke->width *= times;
  };
}

/// A grid of dots so many levels off the paper.
Change pale_grid(int levels) {
  return [levels](Drawing& drawing) {
    const auto off = [levels](std::uint8_t v) {
      return static_cast<std::uint8_t>(v >= 128 ? v - levels : v + levels);
    };
    const Colour paper = drawing.background;
    for (Item& item : drawing.items)
      if (auto* shape = std::get_if<Shape>(&item.what);
          shape && shape->stroke && item.item_class == ItemClass::kGrid)
        shape->stroke = Stroke{{off(paper.red), off(paper.green), off(paper.blue)},
                               1.25 * 72.0 / drawing.dpi,
                               {72.0 / drawing.dpi, 144.0 / drawing.dpi}};
  };
}

void lose_grid(Drawing& drawing) {
  std::erase_if(drawing.items,
                [](const Item& item) { return item.item_class == ItemClass::kGrid; });
}

/// A wave of 60 pixels, or what fits, drawn through so many points.
Change with_wave(int waves, int points) {
  return [=](Drawing& drawing) {
    const double px = 72.0 / drawing.dpi;
    const Box frame = drawing.frames.front();
    const double height = std::min(60.0 * px, 0.3 * frame.height());
    Shape wave{.path = {}, .fill = {}, .stroke = Stroke{{0x20, 0x60, 0xA0}, 1.5 * px, {}}};
    for (int i = 0; i < points; ++i) {
      const double part = static_cast<double>(i) / (points - 1);
      const Point at{frame.x0 + part * frame.width(),
                     frame.centre().y + height * std::sin(2 * std::numbers::pi * waves * part)};
      i == 0 ? wave.path.move_to(at) : wave.path.line_to(at);
    }
    drawing.add(ItemClass::kLine, 0, std::move(wave));
  };
}

/// All items of a class moved by pixels; of text any class.
struct LayerMove {
  std::string layer;
  std::function<bool(const Item&)> is_in;
  double right_px = 0.0, down_px = 0.0;

  void operator()(Drawing& drawing) const {
    const double px = 72.0 / drawing.dpi;
    const auto moved = [&](Point at) { return Point{at.x + right_px * px, at.y + down_px * px}; };
    for (Item& item : drawing.items) {
      if (!is_in(item)) continue;
      if (auto* stamp = std::get_if<Stamp>(&item.what)) stamp->at = moved(stamp->at);
      if (auto* line = std::get_if<TextLine>(&item.what)) line->at = moved(line->at);
      if (auto* shape = std::get_if<Shape>(&item.what))
        for (Point& point : shape->path.points) point = moved(point);
    }
  }
};

bool is_text(const Item& item) { return std::holds_alternative<TextLine>(item.what); }

std::vector<LayerMove> layer_moves() {
  std::vector<LayerMove> moves;
  const auto is_of = [](ItemClass item_class) {
    return
        [item_class](const Item& item) { return item.item_class == item_class && !is_text(item); };
  };
  for (const auto& [right, down] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {-1.0, 1.0}}) {
    moves.push_back({"markers", is_of(ItemClass::kMarker), right, down});
    moves.push_back({"lines", is_of(ItemClass::kLine), right, down});
    moves.push_back({"text", is_text, right, down});
  }
  return moves;
}

Change without(std::size_t item) {
  return [item](Drawing& drawing) { drawing.items.erase(drawing.items.begin() + item); };
}

class SubtleMutations {
 public:
  SubtleMutations(const Drawing& drawing, std::string image)
      : drawing_(drawing), image_(std::move(image)) {}

  std::vector<Mutation> all() {
    using enum ImageState;
    const Change none = [](Drawing&) {};
    for (const Colour colour : line_colours(drawing_))
      for (const double times : {0.7, 1.25, 1.5})
        add(fmt::format("curve {} {} times as thick", hex(colour), times), kDifferent, {none},
            {thicker(colour, times)});
    if (std::ranges::find(drawing_.items, ItemClass::kGrid, &Item::item_class) !=
        drawing_.items.end())
      for (const int levels : {4, 6})
        add(fmt::format("grid of dots {} levels off lost", levels), kDifferent, {pale_grid(levels)},
            {lose_grid});
    add("smooth wave of 99 points for 100", kWithinTolerance, {with_wave(1, 100)},
        {with_wave(1, 99)});
    for (const auto& [right, down] : {std::pair{0.1, 0.0}, {-0.07, 0.07}}) changes(right, down);
    for (const LayerMove& move : layer_moves())
      if (std::ranges::any_of(drawing_.items, move.is_in))
        add(fmt::format("all {} moved {} {} px", move.layer, move.right_px, move.down_px),
            kDifferent, {none}, {move});
    hints();
    return std::move(found_);
  }

 private:
  struct Version {
    Change change;
    Style style = {};
  };

  void add(std::string name, ImageState expected, const Version& before, const Version& after) {
    const auto made = [drawing = drawing_](const Version& version) {
      Drawing other = drawing;
      version.change(other);
      return drawn(other, version.style);
    };
    found_.push_back({std::move(name), image_, expected, [=] { return made(before); },
                      [=] { return made(after); }});
  }

  /// The middle one of the items of a class.
  std::vector<std::size_t> one(ItemClass item_class) const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < drawing_.items.size(); ++i) {
      const Item& item = drawing_.items[i];
      const auto* text = std::get_if<TextLine>(&item.what);
      if (item.item_class == item_class &&
          (!text || text->shaped.text.find_last_of("0123456789") != std::string::npos))
        all.push_back(i);
    }
    return all.empty() ? all : std::vector{all[all.size() / 2]};
  }

  /// Whether the changed shape is not covered by others.
  bool is_seen(const Change& change) const {
    Drawing other = drawing_;
    change(other);
    const Image before = drawn(drawing_), after = drawn(other);
    int seen = 0;
    for (std::size_t i = 0; i < before.pixels.size(); ++i)
      for (const int shift : {16, 8, 0})
        seen += std::abs(static_cast<int>(before.pixels[i] >> shift & 0xFF) -
                         static_cast<int>(after.pixels[i] >> shift & 0xFF)) > 64;
    return seen > 24;
  }

  /// One shape changed, and everything moved.
  void changes(double right, double down) {
    const Change none = [](Drawing&) {};
    const auto moved = [&](const std::string& name, const Change& change) {
      if (!is_seen(change)) return;
      add(fmt::format("{}, all moved {} {} px", name, right, down), ImageState::kDifferent, {none},
          {change, {.right_px = right, .down_px = down}});
    };
    for (const std::size_t i : one(ItemClass::kMarker)) moved("marker lost", without(i));
    for (const std::size_t i : one(ItemClass::kLine)) moved("line lost", without(i));
    for (const std::size_t i : one(ItemClass::kTickLabel))
      for (const int by : {1, 3, 6}) moved(fmt::format("digit {} further", by), other_digit(i, by));
  }

  /// As matplotlib's text.hinting: none, the font's own, the rasterizer's.
  void hints() {
    const Change none = [](Drawing&) {};
    const Style plain{.outlined = false};
    const Style automatic{.hinting = CAIRO_HINT_STYLE_FULL, .outlined = false, .font_hints = false};
    const Style own{.hinting = CAIRO_HINT_STYLE_FULL, .outlined = false};
    add("hinted by the rasterizer", ImageState::kWithinTolerance, {none, plain}, {none, automatic});
    add("hinted by the font for the rasterizer", ImageState::kWithinTolerance, {none, automatic},
        {none, own});
    for (const auto& [right, down] : {std::pair{0.0, 1.0}, {0.0, -1.0}, {1.0, 0.0}})
      add(fmt::format("hinted by the rasterizer and moved {} {} px", right, down),
          ImageState::kWithinTolerance, {none, plain},
          {LayerMove{"text", is_text, right, down}, automatic});
    for (const std::size_t i : one(ItemClass::kTickLabel))
      for (const int by : {1, 3, 6})
        add(fmt::format("hinted digit {} further", by), ImageState::kDifferent, {none, automatic},
            {other_digit(i, by), automatic});
  }

  Drawing drawing_;
  std::string image_;
  std::vector<Mutation> found_;
};

}  // namespace

Change other_digit(std::size_t item, int by) {
  return [=](Drawing& drawing) {
    auto& shaped = std::get<TextLine>(drawing.items[item].what).shaped;
    std::string text = shaped.text;
    char& digit = text[text.find_last_of("0123456789")];
    digit = static_cast<char>('0' + (digit - '0' + by) % 10);
    shaped = shape_text(text);
  };
}

std::vector<Mutation> subtle_mutations_of(const Drawing& drawing, const std::string& image) {
  return SubtleMutations(drawing, image).all();
}

}  // namespace mapproof::test
