#include "render/plot/drawing.hpp"

#include <utility>

namespace mapproof {

std::string_view name(Role role) {
  switch (role) {
    case Role::kGrid:
      return "grid";
    case Role::kFrame:
      return "frame";
    case Role::kTick:
      return "tick";
    case Role::kTickLabel:
      return "tick-label";
    case Role::kAxisLabel:
      return "axis-label";
    case Role::kTitle:
      return "title";
    case Role::kPanelTitle:
      return "panel-title";
    case Role::kNote:
      return "note";
    case Role::kPanelArrow:
      return "panel-arrow";
    case Role::kPanelArrowLabel:
      return "panel-arrow-label";
    case Role::kBand:
      return "band";
    case Role::kCells:
      return "cells";
    case Role::kLine:
      return "line";
    case Role::kMarker:
      return "marker";
    case Role::kMarkLabel:
      return "mark-label";
    case Role::kCellText:
      return "cell-text";
    case Role::kImage:
      return "image";
    case Role::kLeader:
      return "leader";
    case Role::kLegendBox:
      return "legend-box";
    case Role::kLegendText:
      return "legend-text";
    case Role::kLegendSample:
      return "legend-sample";
  }
  return "";
}

Box ink_box(const TextLine& line) {
  const Box& ink = line.shaped.ink;
  const double em = line.size;
  if (line.upward)
    return {line.at.x + ink.y0 * em, line.at.y - ink.x1 * em, line.at.x + ink.y1 * em,
            line.at.y - ink.x0 * em};
  return {line.at.x + ink.x0 * em, line.at.y + ink.y0 * em, line.at.x + ink.x1 * em,
          line.at.y + ink.y1 * em};
}

Item& Drawing::add_text(Role role, std::size_t panel, TextLine line) {
  if (line.whole == line.shaped.text) line.whole.clear();
  return add(role, panel, std::move(line));
}

}  // namespace mapproof
