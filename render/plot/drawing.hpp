#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/base/geometry.hpp"
#include "render/image/image.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/colour.hpp"
#include "render/theme/font.hpp"

namespace mapproof {

/// What a drawn thing is for; tests and style sheets go by it.
enum class ItemClass {
  kGrid,
  kFrame,
  kTick,
  kTickLabel,
  kAxisLabel,
  kTitle,
  kPanelArrow,
  kPanelArrowLabel,
  kPanelTitle,
  kNote,
  kBand,
  kCells,
  kLine,  ///< Joins or shows data.
  kMarker,
  kMarkLabel,
  kCellText,  ///< On a cell, in black or white, whichever reads better there.
  kImage,
  kLeader,  ///< From a mark's label to its mark.
  kLegendBox,
  kLegendText,
  kLegendSample,
};

/// "tick-label": for class names.
std::string_view name(ItemClass item_class);

struct Stroke {
  Colour colour;
  double width = 1.0;
  std::vector<double> dashes;  ///< On, off, …; empty: solid.
  bool is_round = false;       ///< Its ends and corners.
};

/// An outline, filled, stroked or both.
struct Shape {
  Outline path;
  std::optional<Colour> fill;
  double fill_opacity = 1.0;
  std::optional<Stroke> stroke;
  double circle_radius = 0.0;  ///< If above 0, `path` is a circle of this radius about the origin.
};

/// A symbol of the drawing, moved to a point.
struct Stamp {
  std::size_t symbol = 0;
  Point at;
};

/// A line of text.
struct TextLine {
  ShapedText shaped;
  std::string whole = {};  ///< What was asked for, if the drawn text is another.
  Point at = {};           ///< The start of the baseline.
  double size = 0.0;       ///< Of 1 em.
  bool upward = false;     ///< Read from below to above.
  Colour colour = {};
};

/// A raster image; without pixels it is not drawn.
struct Raster {
  Box position;
  std::size_t source = 0;  ///< See ImageLayer.
  std::shared_ptr<const Image> image;
  /// The same in the colours of a dark page; only SVG has it.
  std::shared_ptr<const Image> dark = nullptr;
};

/// The part of the drawing that a line covers.
Box text_box(const TextLine& line);

struct Item {
  ItemClass item_class = ItemClass::kMarker;
  bool clipped = false;  ///< To the frame of its panel.
  std::size_t panel = 0;
  std::optional<std::size_t> mark;  ///< Index in Drawing::marks.
  std::variant<Shape, Stamp, TextLine, Raster> what;
};

/// An axis as its tick labels count.
struct AxisNumbers {
  Scale scale = Scale::kLinear;
  Range ends;  ///< At the left and right, or the lower and upper side of the frame.
};

/// Both axes of a frame; none where ticks are names, or where there are no axes.
struct FrameNumbers {
  std::optional<AxisNumbers> x, y;
};

/// A figure laid out: all that a back end needs, in points, the first item lowest.
struct Drawing {
  std::string id, title, caption, alt;
  std::vector<std::string> record_ids;
  bool varies = false;
  std::string renderer;  ///< What made its rasters; empty if it has none.
  double width = 0.0;
  double height = 0.0;
  double dpi = 72.0;
  Colour background;
  FontHandle font = {};               ///< Of all texts; none: the embedded one.
  std::vector<Box> frames;            ///< One a panel.
  std::vector<FrameNumbers> numbers;  ///< One a frame.
  std::vector<Shape> symbols;         ///< About the origin.
  std::vector<Mark> marks;
  std::vector<Item> items;

  /// Adds an item on top of the others.
  template <typename What>
  Item& add(ItemClass item_class, std::size_t panel, What&& what) {
    Item& item = items.emplace_back();
    item.item_class = item_class;
    item.panel = panel;
    item.what = std::forward<What>(what);
    return item;
  }

  /// Adds a line of text on top of the others. Its `whole` is what was asked for, also if that is
  /// what is drawn.
  Item& add_text(ItemClass item_class, std::size_t panel, TextLine line);
};

}  // namespace mapproof
