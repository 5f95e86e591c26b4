#include "render/plot/layout.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "render/plot/axes_layout.hpp"
#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/plot/layers.hpp"
#include "render/plot/panel_grid.hpp"
#include "render/plot/panel_layout.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {
namespace {

constexpr double kLeastOfPage = 0.3;     // Of the theme's height, for a frame of equal scales.
constexpr double kLeastWithTitle = 0.5;  // Of the page below title and notes, for other frames;
constexpr double kLeastWithout = 0.66;   // of a page in a text, whose caption has the title, more.
constexpr double kMostOfHead = 0.4;      // Of the page's height; below it, the panels.

/// Title and notes from the top of the page down.
class Head {
 public:
  Head(const Figure& figure, const Box& page, const Theme& theme, Drawing& drawing)
      : figure_(figure), page_(page), theme_(theme), drawing_(drawing), y_(page.y0) {}

  /// The room that is left.
  Box draw() {
    if (theme_.draws_title)
      add(figure_.title, ItemClass::kTitle, theme_.title_font_pt, theme_.text, kMostTitleLines);
    const double em = theme_.tick_font_pt;
    for (std::size_t i = 0; i < figure_.notes.size() && draws_notes(figure_, theme_); ++i) {
      const double end = page_.y0 + kMostOfHead * page_.height() - 3.0 * FontFacts::kLine * em;
      if (y_ > end && i + 1 < figure_.notes.size()) {
        add(fmt::format("… and {} more notes", figure_.notes.size() - i), ItemClass::kNote, em,
            theme_.text, kMostNoteLines);
        break;
      }
      add(figure_.notes[i].text, ItemClass::kNote, em, theme_.of(figure_.notes[i].colour),
          kMostNoteLines);
    }
    if (y_ > page_.y0) y_ += theme_.space_pt;
    return {page_.x0, y_, page_.x1, page_.y1};
  }

 private:
  static constexpr std::size_t kMostTitleLines = 3, kMostNoteLines = 2;

  /// The text in lines; where the last one would be short, in as many narrower ones.
  std::vector<ShapedText> without_widow(const std::string& text, double most,
                                        std::size_t most_lines) const {
    constexpr double kShortest = 0.3, kStep = 0.04;  // Of the width.
    const auto wrapped = [&](double width) {
      return wrap_text(text, width, most_lines, theme_.font.get());
    };
    std::vector<ShapedText> lines = wrapped(most);
    const std::size_t count = lines.size();
    if (count < 2 || lines.back().advance > most) return lines;
    for (double width = most; lines.back().advance < kShortest * most; width -= kStep * most) {
      std::vector<ShapedText> narrower = wrapped(width - kStep * most);
      const bool is_whole = narrower.size() == count && text.ends_with(narrower.back().text);
      if (!is_whole || width < 0.5 * most) break;
      lines = std::move(narrower);
    }
    return lines;
  }

  void add(const std::string& text, ItemClass item_class, double em, Colour colour,
           std::size_t most_lines) {
    for (const ShapedText& line : without_widow(text, page_.width() / em, most_lines)) {
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

/// What title and notes take of a page of the theme's height.
double head_height(const Figure& figure, const Theme& theme) {
  const double margin = theme.space_pt;
  const Box page{margin, margin, theme.width_pt - margin, theme.height_pt - margin};
  Drawing unused;
  return Head(figure, page, theme, unused).draw().y0;
}

/// @param height   Of the page; that of several panels follows from them.
/// @param stretch  Of the rows of several panels.
Drawing lay_out_on(const Figure& figure, const Theme& theme, double height, double stretch = 1.0) {
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
    lay_out_grid(figure, room, theme, stretch, drawing);
  return drawing;
}

constexpr double kLeastHigher = 0.5;  // In points.
constexpr double kHigher = 1.1;       // Factor from one height of a page to the next one tried.
constexpr double kMostFree = 0.1;     // Of a page, below everything that is drawn.
constexpr double kHighestPage = 684.0;  // In points: of a printed page with a caption.
constexpr int kMostStretches = 6, kMostPages = 3;

/// The height of the page at which the only frame has its share of it, and each row its name.
double height_for_frame(const Figure& figure, const Theme& theme, const Drawing& drawing) {
  const double frame = drawing.frames[0].height();
  if (figure.panels[0].bare || (figure.panels[0].equal_aspect && theme.draws_title))
    return drawing.height + kLeastOfPage * theme.height_pt - frame;
  // Around the frame everything keeps its height.
  const double head = theme.draws_title ? head_height(figure, theme) : 0.0;
  const double for_share = head + (drawing.height - head - frame) /
                                      (1.0 - (theme.draws_title ? kLeastWithTitle : kLeastWithout));
  const AxesLayout axes(figure.panels[0], theme);
  return std::max(for_share,
                  drawing.height + axes.height_of_names(drawing.frames[0].width()) - frame);
}

/// What of the height of a page the frames of several panels take, 0 to 1: what has a frame, not
/// how many are beside each other.
double share_of_frames(const Drawing& drawing) {
  std::vector<Box> frames = drawing.frames;
  std::ranges::sort(frames, {}, &Box::y0);
  double taken = 0.0, end = 0.0;
  for (const Box& frame : frames) {
    taken += std::max(0.0, frame.y1 - std::max(frame.y0, end));
    end = std::max(end, frame.y1);
  }
  return taken / drawing.height;
}

/// How many different places the frames have along an axis: rows by `y0`, columns by `x0`.
std::size_t count_places(const Drawing& drawing, double Box::*side) {
  std::set<double> places;
  for (const Box& frame : drawing.frames) places.insert(std::round(frame.*side));
  return places.size();
}

/// Maps are as high as they are wide: until they have their share of the page, fewer of them are
/// beside each other, as long as a printed page holds all.
Drawing with_larger_maps(const Figure& figure, const Theme& theme, Drawing drawing) {
  Figure fewer = figure;
  while (share_of_frames(drawing) < kLeastWithout && count_places(drawing, &Box::x0) > 1) {
    fewer.columns = count_places(drawing, &Box::x0) - 1;
    Drawing higher = lay_out_on(fewer, theme, theme.height_pt);
    double stretch = 1.0;
    for (int i = 0; i < kMostStretches && higher.height > kHighestPage; ++i) {
      const double frames = share_of_frames(higher) * higher.height;
      stretch *= 1.0 - std::min((higher.height - kHighestPage + 1.0) / frames, 0.5);
      higher = lay_out_on(fewer, theme, theme.height_pt, stretch);
    }
    if (higher.height > kHighestPage || share_of_frames(higher) < share_of_frames(drawing)) break;
    drawing = std::move(higher);
  }
  // Of one column they may be as wide as the page.
  const bool is_column = count_places(drawing, &Box::x0) == 1;
  double stretch = kHigher;
  for (int i = 0; is_column && i < kMostStretches && share_of_frames(drawing) < kLeastWithout;
       ++i) {
    Drawing higher = lay_out_on(fewer, theme, theme.height_pt, stretch);
    if (higher.height > kHighestPage) break;
    drawing = std::move(higher);
    stretch *= kHigher;
  }
  return drawing;
}

/// Several panels on a page in a text, which is as much higher as they need for their share.
Drawing lay_out_rows(const Figure& figure, const Theme& theme) {
  Drawing drawing = lay_out_on(figure, theme, theme.height_pt);
  if (theme.draws_title || !figure.arrows.empty()) return drawing;
  const auto keeps_proportions = [](const Panel& panel) {
    return panel.equal_aspect || has_image(panel);
  };
  if (std::ranges::all_of(figure.panels, keeps_proportions))
    return with_larger_maps(figure, theme, std::move(drawing));
  if (std::ranges::any_of(figure.panels, &Panel::bare)) return drawing;
  double stretch = 1.0;
  for (int i = 0; i < kMostStretches; ++i) {
    const double share = share_of_frames(drawing);
    if (share >= kLeastWithout) break;
    // Around the frames everything keeps its height.
    double frames = 0.0;
    for (const Box& frame : drawing.frames) frames = std::max(frames, frame.height());
    const double missing = (kLeastWithout - share) / (1.0 - kLeastWithout) * drawing.height;
    stretch *= 1.0 + missing / (static_cast<double>(count_places(drawing, &Box::y0)) * frames);
    drawing = lay_out_on(figure, theme, theme.height_pt, stretch);
  }
  return drawing;
}

/// A page that holds all texts at points below each other, in points.
double height_of_texts(const Drawing& drawing) {
  double height = 0.0;
  for (const Item& item : drawing.items)
    if (item.item_class == ItemClass::kMarkLabel)
      height += FontFacts::kLine * std::get<TextLine>(item.what).size;
  return height;
}

/// Whether texts at points are closer than half an em, one above the other; lines of one text may
/// be.
bool has_crowded_texts(const Drawing& drawing) {
  constexpr double kGap = 0.25;  // Around a line, em.
  std::vector<std::pair<Box, const TextLine*>> lines;
  for (const Item& item : drawing.items) {
    if (item.item_class != ItemClass::kMarkLabel) continue;
    const auto& line = std::get<TextLine>(item.what);
    const Box box = text_box(line).grown(kGap * line.size);
    if (std::ranges::any_of(lines, [&](const auto& other) {
          return box.overlaps(other.first) && line.at.y != other.second->at.y &&
                 (line.whole.empty() || line.whole != other.second->whole);
        }))
      return true;
    lines.emplace_back(box, &line);
  }
  return false;
}

}  // namespace

bool draws_notes(const Figure& figure, const Theme& theme) {
  return theme.draws_notes || std::ranges::all_of(figure.panels, [](const Panel& panel) {
           return std::ranges::all_of(panel.layers, is_empty);
         });
}

Drawing lay_out(const Figure& figure, const Theme& theme) {
  require_valid(figure);
  if (figure.panels.size() > 1) return lay_out_rows(figure, theme);
  Drawing drawing = lay_out_on(figure, theme, theme.height_pt);
  // A legend that leaves the frame too little makes the page higher; then it may need more itself.
  const auto lacks = [&](const Drawing& one) {
    return height_for_frame(figure, theme, one) > one.height + kLeastHigher;
  };
  for (int i = 0; i < kMostPages && lacks(drawing); ++i)
    drawing = lay_out_on(figure, theme, height_for_frame(figure, theme, drawing));
  // On the higher page it may have room in the frame, which then needs less.
  for (double height = theme.height_pt * kHigher; height < drawing.height; height *= kHigher)
    if (Drawing lower = lay_out_on(figure, theme, height); !lacks(lower)) {
      drawing = std::move(lower);
      break;
    }
  // Names of several lines beside a diagram need higher rows, however high the page gets by them.
  const double highest = std::max(kHighestPage, height_of_texts(drawing));
  for (double height = drawing.height * kHigher;
       figure.panels[0].bare && !figure.panels[0].equal_aspect && height <= highest &&
       has_crowded_texts(drawing);
       height *= kHigher)
    drawing = lay_out_on(figure, theme, height);
  // Below a frame of equal scales that is as wide as the page and lower, the page ends.
  const double end = lowest_drawn(drawing, 0) + theme.space_pt;
  if (figure.panels[0].equal_aspect && end < (1.0 - kMostFree) * drawing.height)
    drawing.height = end;
  return drawing;
}

}  // namespace mapproof
