#include "render/plot/drawing.hpp"

#include <utility>

namespace mapproof {

std::string_view name(ItemClass item_class) {
  switch (item_class) {
    case ItemClass::kGrid:
      return "grid";
    case ItemClass::kFrame:
      return "frame";
    case ItemClass::kTick:
      return "tick";
    case ItemClass::kTickLabel:
      return "tick-label";
    case ItemClass::kAxisLabel:
      return "axis-label";
    case ItemClass::kTitle:
      return "title";
    case ItemClass::kPanelTitle:
      return "panel-title";
    case ItemClass::kNote:
      return "note";
    case ItemClass::kPanelArrow:
      return "panel-arrow";
    case ItemClass::kPanelArrowLabel:
      return "panel-arrow-label";
    case ItemClass::kBand:
      return "band";
    case ItemClass::kCells:
      return "cells";
    case ItemClass::kLine:
      return "line";
    case ItemClass::kMarker:
      return "marker";
    case ItemClass::kMarkLabel:
      return "mark-label";
    case ItemClass::kCellText:
      return "cell-text";
    case ItemClass::kImage:
      return "image";
    case ItemClass::kLeader:
      return "leader";
    case ItemClass::kLegendBox:
      return "legend-box";
    case ItemClass::kLegendText:
      return "legend-text";
    case ItemClass::kLegendSample:
      return "legend-sample";
  }
  return "";
}

Box text_box(const TextLine& line) {
  const Box& bounds = line.shaped.bounds;
  const double em = line.size;
  if (line.upward)
    return {line.at.x + bounds.y0 * em, line.at.y - bounds.x1 * em, line.at.x + bounds.y1 * em,
            line.at.y - bounds.x0 * em};
  return {line.at.x + bounds.x0 * em, line.at.y + bounds.y0 * em, line.at.x + bounds.x1 * em,
          line.at.y + bounds.y1 * em};
}

Item& Drawing::add_text(ItemClass item_class, std::size_t panel, TextLine line) {
  if (line.whole == line.shaped.text) line.whole.clear();
  return add(item_class, panel, std::move(line));
}

}  // namespace mapproof
