#include "render/plot/layout.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "render/plot/grid_layout.hpp"
#include "render/plot/panel_layout.hpp"

namespace mapproof {
namespace {

constexpr double kLeastOfPage = 0.3;  // Of the theme's height, for the frame.
constexpr double kMostOfHead = 0.4;   // Of the page's height; below it, the panels.

/// Title and notes from the top of the page down.
class Head {
 public:
  Head(const Figure& figure, const Box& page, const Theme& theme, Drawing& drawing)
      : figure_(figure), page_(page), theme_(theme), drawing_(drawing), y_(page.y0) {}

  /// The room that is left.
  Box draw() {
    if (theme_.draws_title)
      add(figure_.title, ItemClass::kTitle, theme_.title_font_pt, theme_.text);
    const double em = theme_.tick_font_pt;
    for (std::size_t i = 0; i < figure_.notes.size() && draws_notes(figure_, theme_); ++i) {
      const double end = page_.y0 + kMostOfHead * page_.height() - 3.0 * FontFacts::kLine * em;
      if (y_ > end && i + 1 < figure_.notes.size()) {
        add(fmt::format("… and {} more notes", figure_.notes.size() - i), ItemClass::kNote, em,
            theme_.text);
        break;
      }
      add(figure_.notes[i].text, ItemClass::kNote, em, theme_.of(figure_.notes[i].colour));
    }
    if (y_ > page_.y0) y_ += theme_.space_pt;
    return {page_.x0, y_, page_.x1, page_.y1};
  }

 private:
  void add(const std::string& text, ItemClass item_class, double em, Colour colour) {
    constexpr std::size_t kMostLines = 2;
    for (const ShapedText& line :
         wrap_text(text, page_.width() / em, kMostLines, theme_.font.get())) {
      drawing_.add_text(item_class, 0,
                        {.shaped = line,
                         .whole = text,
                         .at = {page_.x0, y_ + FontFacts::kAscent * em},
                         .size = em,
                         .colour = colour});
      y_ += FontFacts::kLine * em;
    }
  }

  const Figure& figure_;
  const Box& page_;
  const Theme& theme_;
  Drawing& drawing_;
  double y_;
};

}  // namespace

namespace {

/// @param height  Of the page; that of several panels follows from them.
Drawing lay_out_on(const Figure& figure, const Theme& theme, double height) {
  Drawing drawing;
  drawing.id = figure.id;
  drawing.title = figure.title;
  drawing.caption = figure.caption;
  drawing.alt = figure.alt;
  drawing.record_ids = figure.record_ids;
  drawing.varies = figure.varies;
  drawing.width = theme.width_pt;
  drawing.height = height;
  drawing.dpi = theme.dpi;
  drawing.background = theme.background;
  drawing.font = theme.font;

  const double margin = theme.space_pt;
  const Box page{margin, margin, theme.width_pt - margin, height - margin};
  const Box room = Head(figure, page, theme, drawing).draw();
  if (figure.panels.size() == 1)
    lay_out_panel(figure.panels[0], 0, room, theme, drawing);
  else
    lay_out_grid(figure, room, theme, drawing);
  return drawing;
}

}  // namespace

bool draws_notes(const Figure& figure, const Theme& theme) {
  return theme.draws_notes || std::ranges::all_of(figure.panels, [](const Panel& panel) {
           return std::ranges::all_of(panel.layers, is_empty);
         });
}

Drawing lay_out(const Figure& figure, const Theme& theme) {
  require_valid(figure);
  Drawing drawing = lay_out_on(figure, theme, theme.height_pt);
  if (figure.panels.size() > 1) return drawing;
  // A legend that leaves the frame too little makes the page higher.
  const double missing = kLeastOfPage * theme.height_pt - drawing.frames[0].height();
  if (missing <= 0.0) return drawing;
  return lay_out_on(figure, theme, theme.height_pt + missing);
}

}  // namespace mapproof
