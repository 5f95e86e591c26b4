#include "render/plot/layout.hpp"

#include "render/plot/panel_layout.hpp"

namespace mapproof {
namespace {

/// Draws title and notes from the top of `room` down and gives what is left of it.
Box draw_head(const Figure& figure, Box room, const Theme& theme, Drawing& drawing) {
  const auto draw = [&](const std::string& text, Role role, double em, Colour colour, std::size_t lines) {
    for (const ShapedText& line : wrap_text(text, room.width() / em, lines)) {
      add_text(drawing, role, 0, line, text, {room.x0, room.y0 + FontFacts::kAscent * em}, em, colour);
      room.y0 += FontFacts::kLine * em;
    }
  };
  const double top = room.y0;
  if (theme.draws_title && !figure.title.empty())
    draw(figure.title, Role::kTitle, theme.title_font_pt, theme.text, 2);
  for (const Note& note : figure.notes)
    draw(note.text, Role::kNote, theme.tick_font_pt, theme.of(note.ink), 2);
  if (room.y0 > top) room.y0 += theme.space_pt;
  return room;
}

}  // namespace

std::string_view name(Role role) {
  switch (role) {
    case Role::kGrid: return "grid";
    case Role::kFrame: return "frame";
    case Role::kTick: return "tick";
    case Role::kTickLabel: return "tick-label";
    case Role::kAxisLabel: return "axis-label";
    case Role::kTitle: return "title";
    case Role::kPanelTitle: return "panel-title";
    case Role::kNote: return "note";
    case Role::kBand: return "band";
    case Role::kLine: return "line";
    case Role::kMarker: return "marker";
    case Role::kMarkLabel: return "mark-label";
    case Role::kLeader: return "leader";
    case Role::kLegendBox: return "legend-box";
    case Role::kLegendText: return "legend-text";
    case Role::kLegendSample: return "legend-sample";
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

Drawing lay_out(const Figure& figure, const Theme& theme) {
  require_valid(figure);
  Drawing drawing;
  drawing.id = figure.id;
  drawing.title = figure.title;
  drawing.caption = figure.caption;
  drawing.alt = figure.alt;
  drawing.record_ids = figure.record_ids;
  drawing.varies = figure.varies;
  drawing.width = theme.width_pt;
  drawing.height = theme.height_pt;
  drawing.dpi = theme.dpi;
  drawing.background = theme.background;

  const double margin = theme.space_pt;
  const Box page{margin, margin, theme.width_pt - margin, theme.height_pt - margin};
  const Box room = draw_head(figure, page, theme, drawing);
  const auto count = static_cast<double>(figure.panels.size());
  const double gap = 2.0 * theme.space_pt;
  const double width = (room.width() - (count - 1.0) * gap) / count;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const double left = room.x0 + static_cast<double>(p) * (width + gap);
    lay_out_panel(figure.panels[p], p, {left, room.y0, left + width, room.y1}, theme, drawing);
  }
  return drawing;
}

}  // namespace mapproof
