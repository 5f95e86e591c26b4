#include "tests/support/images/figure_checks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "render/cairo/cairo_backend.hpp"

namespace mapproof::test {
namespace {

constexpr double kPixelsPerPoint = 2.0;

bool is_data(ItemClass item_class) {
  return item_class == ItemClass::kBand || item_class == ItemClass::kCells ||
         item_class == ItemClass::kLine || item_class == ItemClass::kMarker;
}

bool blocks_text(ItemClass item_class) {
  return is_data(item_class) || item_class == ItemClass::kFrame || item_class == ItemClass::kTick ||
         item_class == ItemClass::kLeader;
}

/// The pixels of the drawing's items of some classes alone.
template <typename Wanted>
Image image_of(const Drawing& drawing, Wanted wanted) {
  Drawing part = drawing;
  std::erase_if(part.items, [&](const Item& item) { return !wanted(item.item_class); });
  part.dpi = 72.0 * kPixelsPerPoint;
  return to_image(part);
}

/// Whether a pixel wholly inside the box has colour.
bool is_drawn_on(const Image& image, const Box& box, Colour background) {
  const std::uint32_t paper = background.red << 16 | background.green << 8 | background.blue;
  const auto pixel = [](double points) { return points * kPixelsPerPoint; };
  const int x0 = std::max(static_cast<int>(std::ceil(pixel(box.x0))), 0);
  const int y0 = std::max(static_cast<int>(std::ceil(pixel(box.y0))), 0);
  const int x1 = std::min(static_cast<int>(std::floor(pixel(box.x1))), image.width);
  const int y1 = std::min(static_cast<int>(std::floor(pixel(box.y1))), image.height);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if ((image.row(y)[x] & 0xFFFFFF) != paper) return true;
  return false;
}

class Inspector {
 public:
  explicit Inspector(const Drawing& drawing) : drawing_(drawing) {}

  std::vector<std::string> inspect() {
    for (const Item& item : drawing_.items)
      if (const auto* line = std::get_if<TextLine>(&item.what))
        texts_.push_back({&item, line, text_box(*line)});
    check_frames();
    check_borders();
    check_text_on_text();
    check_text_on_marks();
    check_legend_on_data();
    check_contrast();
    check_glyphs();
    return std::move(flaws_);
  }

 private:
  struct Text {
    const Item* item;
    const TextLine* line;
    Box bounds;
  };

  static std::string named(const Text& text) {
    return fmt::format("{} '{}'", name(text.item->item_class), text.line->shaped.text);
  }

  void check_frames() {
    // Panels of a grid may be small.
    const double share = drawing_.frames.size() == 1 ? 0.25 : 0.1;
    const double least = share * std::min(drawing_.width, drawing_.height);
    for (const Box& frame : drawing_.frames)
      if (frame.width() < least || frame.height() < least)
        flaws_.push_back(fmt::format("frame of {:.0f} x {:.0f} pt", frame.width(), frame.height()));
  }

  void check_borders() {
    const Box page{0.0, 0.0, drawing_.width, drawing_.height};
    for (const Text& text : texts_)
      if (!page.holds(text.bounds)) flaws_.push_back(named(text) + " is cut by the border");
    for (const Item& item : drawing_.items)
      if (const auto* stamp = std::get_if<Stamp>(&item.what)) {
        const Box reach =
            bounds(drawing_.symbols[stamp->symbol].path).moved(stamp->at.x, stamp->at.y);
        if (!page.holds(reach)) flaws_.push_back("a marker is cut by the border");
      }
  }

  void check_text_on_text() {
    for (std::size_t i = 0; i < texts_.size(); ++i)
      for (std::size_t j = i + 1; j < texts_.size(); ++j)
        if (texts_[i].bounds.overlaps(texts_[j].bounds))
          flaws_.push_back(named(texts_[i]) + " and " + named(texts_[j]) + " overlap");
  }

  void check_text_on_marks() {
    const Image marks = image_of(drawing_, blocks_text);
    const Image no_cells = image_of(drawing_, [](ItemClass item_class) {
      return blocks_text(item_class) && item_class != ItemClass::kCells;
    });
    for (const Text& text : texts_) {
      const bool is_on_cell = text.item->item_class == ItemClass::kCellText;
      if (is_drawn_on(is_on_cell ? no_cells : marks, text.bounds, drawing_.background))
        flaws_.push_back(named(text) + " covers a line or a mark");
    }
  }

  /// What a text of a cell stands on.
  Colour below(const Text& text) const {
    if (text.item->item_class != ItemClass::kCellText) return drawing_.background;
    if (cells_.width == 0)
      cells_ =
          image_of(drawing_, [](ItemClass item_class) { return item_class == ItemClass::kCells; });
    const Point middle = text.bounds.centre();
    const auto pixel = [](double points) { return static_cast<int>(points * kPixelsPerPoint); };
    return colour(cells_.row(pixel(middle.y))[pixel(middle.x)] & 0xFFFFFF);
  }

  void check_legend_on_data() {
    const Image data = image_of(drawing_, is_data);
    for (const Item& item : drawing_.items) {
      if (item.item_class != ItemClass::kLegendBox && item.item_class != ItemClass::kLegendSample)
        continue;
      const auto* shape = std::get_if<Shape>(&item.what);
      if (shape != nullptr &&
          is_drawn_on(data, bounds(shape->path).grown(0.5), drawing_.background))
        flaws_.push_back(fmt::format("{} covers data", name(item.item_class)));
    }
  }

  void check_contrast() {
    for (const Text& text : texts_)
      if (contrast(text.line->colour, below(text)) < 4.5)
        flaws_.push_back(named(text) + " has too little contrast");
    bool was_round = false;
    for (const Item& item : drawing_.items) {
      const auto* stamp = std::get_if<Stamp>(&item.what);
      const auto* shape =
          stamp != nullptr ? &drawing_.symbols[stamp->symbol] : std::get_if<Shape>(&item.what);
      const bool counts =
          item.item_class == ItemClass::kLine || item.item_class == ItemClass::kMarker ||
          item.item_class == ItemClass::kFrame || item.item_class == ItemClass::kTick;
      if (shape == nullptr || !counts) continue;
      // Of a line in the colours of its values the rim, which is the first of its strokes.
      const bool is_round = shape->stroke && shape->stroke->is_round;
      if (std::exchange(was_round, is_round) && is_round) continue;
      // Of lines as wide as the true path of a drive less is seen, too: they are areas.
      constexpr double kWide_pt = 3.0;
      const bool is_wide = shape->stroke && shape->stroke->width >= kWide_pt;
      const Colour seen = shape->stroke ? shape->stroke->colour : *shape->fill;
      if (contrast(seen, drawing_.background) < (is_wide ? 1.5 : 3.0))
        flaws_.push_back(fmt::format("a {} has too little contrast", name(item.item_class)));
    }
  }

  void check_glyphs() {
    for (const Text& text : texts_)
      for (const Glyph& glyph : text.line->shaped.glyphs)
        if (glyph.index == 0) flaws_.push_back(named(text) + " has a glyph that the font lacks");
  }

  const Drawing& drawing_;
  std::vector<Text> texts_;
  mutable Image cells_;  ///< The cells alone, once a text on one is met.
  std::vector<std::string> flaws_;
};

}  // namespace

std::vector<std::string> flaws(const Drawing& drawing) { return Inspector(drawing).inspect(); }

}  // namespace mapproof::test
