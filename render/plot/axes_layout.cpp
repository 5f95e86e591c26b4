#include "render/plot/axes_layout.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>
#include <vector>

#include "render/plot/axis_map.hpp"
#include "render/plot/outlines.hpp"
#include "render/plot/short_names.hpp"
#include "render/theme/font.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

constexpr double kBarWidth = 1.2;   // em of the axis labels.
constexpr double kLabelRoom = 1.6;  // Of one line of the label, em.
constexpr int kBarSteps = 64;

struct Bar {
  Ticks ticks;
  std::vector<ShapedText> texts;
  double widest_pt = 0.0;
  double gap_pt = 0.0;   ///< From the frame to the bar.
  double tick_pt = 0.0;  ///< Length of a tick, and the gap to its label.
};

Bar bar_of(const ColourScale& colours, double height, const Theme& theme) {
  const double em = theme.tick_font_pt;
  const int most = std::clamp(static_cast<int>(height / (2.6 * em)), 2, 8);
  const auto [low, high] = colours.limits;
  Bar bar;
  bar.ticks = colours.scale == Scale::kLog ? log_ticks(low, high, std::max(most, 3))
                                           : linear_ticks(low, high, tick_step(low, high, most));
  for (const std::string& text : bar.ticks.labels) {
    bar.texts.push_back(shape_text(text, theme.font.get()));
    bar.widest_pt = std::max(bar.widest_pt, bar.texts.back().advance * em);
  }
  bar.gap_pt = 2.0 * theme.space_pt;
  bar.tick_pt = 0.6 * theme.space_pt;
  return bar;
}

std::string whole_label(const ColourScale& colours, const Ticks& ticks) {
  return ticks.factor.empty() ? colours.bar_label : colours.bar_label + " " + ticks.factor;
}

constexpr double kWidestName = 9.0;  // Of a tick's label, em; numbers are shorter.
// Of a row's label: wider in a frame that has the room.
constexpr double kLeastRowName = 13.5, kWidestRowName = 16.0;
constexpr double kRowNameShare = 0.38;     // Of the frame's width.
constexpr double kNamedRow = 1.6;          // Of a row whose name is one line, em.
constexpr std::size_t kMostRows = 100;     // Of more, not all have their names.
constexpr double kLeastTickGap = 0.25;     // Between labels of ticks that cannot be fewer, em.
constexpr std::size_t kFewestToHalve = 3;  // Of labels that touch; two are left.
constexpr std::size_t kFewestLabels = 3;   // Where there is room.
constexpr double kLeastUpward = 1.8;       // Distance of labels one above the other, em,
constexpr double kLeastAcross = 2.4;       // and of short ones beside each other.
constexpr double kLabelLine = 1.55;        // From the foot of tick labels to the axis label's, em.

/// Names, which may come from anywhere, in lines of that width.
TickLabels shaped(Ticks ticks, const Theme& theme, double widest_em = kWidestName) {
  TickLabels labels{std::move(ticks), {}, 0.0};
  for (const std::string& text : labels.ticks.labels) {
    labels.texts.push_back(name_lines(theme, text, widest_em));
    labels.widest = std::max(labels.widest, labels.width(labels.texts.size() - 1));
  }
  return labels;
}

/// What the lines of a label take after the first one, em.
double further_lines_of(const TickLabels& labels) {
  const std::size_t lines = labels.lines();
  return lines == 0 ? 0.0 : kNameLineStep * static_cast<double>(lines - 1);
}

bool is_number(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// What a row's name may take across, em.
double widest_row_name(double frame_width, double em) {
  return std::clamp(kRowNameShare * frame_width / em, kLeastRowName, kWidestRowName);
}

/// Every second tick, the others without a label.
Ticks every_second(const Ticks& ticks) {
  Ticks left = ticks;
  left.at.clear();
  left.labels.clear();
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    if (i % 2 == 1) {
      left.minor.push_back(ticks.at[i]);
      continue;
    }
    left.at.push_back(ticks.at[i]);
    left.labels.push_back(ticks.labels[i]);
  }
  return left;
}

/// Every so-manieth name, so that at most `most` are left.
Ticks named_ticks(const std::vector<std::string>& names, const Range& range, int most) {
  Ticks ticks;
  const std::size_t step =
      (names.size() + static_cast<std::size_t>(most) - 1) / static_cast<std::size_t>(most);
  for (std::size_t i = 0; i < names.size(); i += step) {
    const auto at = static_cast<double>(i);
    if (at < range.low || at > range.high) continue;
    ticks.at.push_back(at);
    ticks.labels.push_back(names[i]);
  }
  return ticks;
}

/// The first layer that asks for a colour bar.
struct BarLayer {
  const ColourScale* colours = nullptr;  ///< Null if none does.
  ThemeColour colour = ThemeColour::kText;
};

BarLayer layer_with_bar(const Panel& panel) {
  BarLayer found;
  for (const Layer& layer : panel.layers)
    std::visit(
        [&](const auto& one) {
          if constexpr (requires { one.colour_scale; })
            if (found.colours == nullptr && !one.values.empty() &&
                !one.colour_scale.bar_label.empty())
              found = {&one.colour_scale, one.colour};
        },
        layer);
  return found;
}

}  // namespace

bool has_colour_bar(const Panel& panel) { return layer_with_bar(panel).colours != nullptr; }

double colour_bar_room(const Panel& panel, double height, const Theme& theme) {
  const ColourScale* colours = layer_with_bar(panel).colours;
  if (colours == nullptr) return 0.0;
  const Bar bar = bar_of(*colours, height, theme);
  return bar.gap_pt + kBarWidth * theme.font_pt + 2.0 * bar.tick_pt + bar.widest_pt +
         kLabelRoom * theme.font_pt + colour_bar_label_room(panel, height, theme);
}

double colour_bar_label_room(const Panel& panel, double height, const Theme& theme) {
  const ColourScale* colours = layer_with_bar(panel).colours;
  if (colours == nullptr) return 0.0;
  const std::string label = whole_label(*colours, bar_of(*colours, height, theme).ticks);
  return further_lines(upward_lines(label, height, theme), theme.font_pt);
}

void draw_colour_bar(const Panel& panel, std::size_t panel_index, const Box& frame,
                     const Theme& theme, Drawing& drawing) {
  const auto [colours, colour] = layer_with_bar(panel);
  if (colours == nullptr) return;
  const Bar bar = bar_of(*colours, frame.height(), theme);
  const Box box{frame.x1 + bar.gap_pt, frame.y0, frame.x1 + bar.gap_pt + kBarWidth * theme.font_pt,
                frame.y1};
  const auto add = [&](Shape shape) {
    drawing.add(ItemClass::kLegendSample, panel_index, std::move(shape));
  };
  for (int i = 0; i < kBarSteps; ++i) {
    // Each piece reaches to the top, so that no background shows between two.
    Shape piece;
    piece.path.add_box(
        {box.x0, box.y0, box.x1, std::lerp(box.y1, box.y0, static_cast<double>(i) / kBarSteps)});
    piece.fill =
        ramp_colour(colours->ramp, colour, static_cast<double>(i) / (kBarSteps - 1), theme);
    add(std::move(piece));
  }
  Shape rim;
  rim.path.add_box(box);
  const AxisMap y(colours->scale, colours->limits, box.y1, box.y0);
  for (const double value : bar.ticks.at) {
    rim.path.move_to({box.x1, y(value)});
    rim.path.line_to({box.x1 + bar.tick_pt, y(value)});
  }
  rim.stroke = Stroke{theme.text, theme.hairline_pt, {}};
  add(std::move(rim));
  for (std::size_t i = 0; i < bar.texts.size(); ++i)
    drawing.add_text(ItemClass::kLegendText, panel_index,
                     {.shaped = bar.texts[i],
                      .whole = bar.texts[i].text,
                      .at = {box.x1 + 2.0 * bar.tick_pt,
                             y(bar.ticks.at[i]) + FontFacts::kCapHeight * theme.tick_font_pt / 2.0},
                      .size = theme.tick_font_pt,
                      .colour = theme.text});
  const double em = theme.font_pt;
  const std::string whole = whole_label(*colours, bar.ticks);
  double x = box.x1 + 2.0 * bar.tick_pt + bar.widest_pt + 1.3 * em;
  for (const ShapedText& line : upward_lines(whole, frame.height(), theme)) {
    drawing.add_text(ItemClass::kLegendText, panel_index,
                     {.shaped = line,
                      .whole = whole,
                      .at = {x, frame.centre().y + line.advance * em / 2.0},
                      .size = em,
                      .upward = true,
                      .colour = theme.text});
    x += FontFacts::kLine * em;
  }
}

std::string axis_title(const Axis& axis, const Ticks& ticks) {
  return ticks.factor.empty() ? axis.label : axis.label + " " + ticks.factor;
}

std::vector<ShapedText> upward_lines(const std::string& label, double height, const Theme& theme) {
  constexpr std::size_t kMostLines = 3;
  return wrap_text(label, std::max(height, 0.0) / theme.font_pt, kMostLines, theme.font.get());
}

double further_lines(const std::vector<ShapedText>& lines, double em) {
  return lines.empty() ? 0.0 : static_cast<double>(lines.size() - 1) * FontFacts::kLine * em;
}

double TickLabels::width(std::size_t i) const {
  double widest = 0.0;
  for (const ShapedText& line : texts[i]) widest = std::max(widest, line.advance);
  return widest;
}

std::size_t TickLabels::lines() const {
  std::size_t most = 0;
  for (const std::vector<ShapedText>& lines : texts) most = std::max(most, lines.size());
  return most;
}

AxesLayout::AxesLayout(const Panel& panel, const Theme& theme, AxisLabels shown)
    : panel_(panel), theme_(theme), shown_(shown), limits_(panel_limits(panel)) {}

Axes AxesLayout::within(const Box& room) const {
  // The margins depend on the labels, those on the frame: twice is enough, but for long labels
  // that fall into more lines beside a shorter frame.
  constexpr int kMostPasses = 4;
  Axes axes;
  axes.frame = room;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    axes = in(axes.frame);
    const double lines = label_lines(axes);
    const Margins m = margins(axes);
    axes.frame = {room.x0 + m.left, room.y0 + m.top, room.x1 - m.right, room.y1 - m.bottom};
    if (panel_.equal_aspect) shrink_to_aspect(axes.frame);
    if (pass > 0 && label_lines(axes) <= lines) break;
  }
  return axes;
}

Axes AxesLayout::in(const Box& frame) const {
  Axes axes;
  axes.frame = frame;
  if (panel_.bare) return axes;
  choose_ticks(axes);
  if (!shown_.x_ticks) axes.x.texts.clear();
  if (!shown_.y_ticks) axes.y.texts.clear(), axes.y.widest = 0.0;
  return axes;
}

PanelMap AxesLayout::map(const Box& frame) const {
  return {AxisMap(panel_.x.scale, limits_.x, frame.x0, frame.x1),
          AxisMap(panel_.y.scale, limits_.y, frame.y1, frame.y0)};
}

double AxesLayout::below_frame(const Axes& axes) const {
  if (panel_.bare) return 0.0;
  const double label = has_x_label() ? kLabelLine * theme_.font_pt : 0.0;
  const double lines = FontFacts::kAscent + further_lines_of(axes.x);
  const double ticks = shown_.x_ticks ? tick_gap() + lines * theme_.tick_font_pt : 0.0;
  return tick_length() + ticks + label;
}

double AxesLayout::height_of_names(double width) const {
  const std::vector<std::string>& names = panel_.y.names;
  if (names.size() > kMostRows || std::ranges::all_of(names, is_number)) return 0.0;
  const double em = theme_.tick_font_pt;
  std::vector<double> heights;
  for (const std::string& name : names)
    heights.push_back(
        kNameLineStep *
        static_cast<double>(name_lines(theme_, name, widest_row_name(width, em)).size()));
  // No name may reach the next one, or over the frame.
  const auto last = static_cast<double>(names.size() - 1);
  double row = std::max({kNamedRow, 0.5 * heights.front() / std::max(0.5, -limits_.y.low),
                         0.5 * heights.back() / std::max(0.5, limits_.y.high - last)});
  for (std::size_t i = 1; i < heights.size(); ++i)
    row = std::max(row, 0.5 * (heights[i - 1] + heights[i]) + kNamedRow - kNameLineStep);
  const double rows = row > kNamedRow ? limits_.y.high - limits_.y.low : last + 1.0;
  return std::min(rows, last + 2.0) * row * em + 1.0;
}

/// All names, or as many as have room.
TickLabels AxesLayout::named_rows(const Box& frame) const {
  const double em = theme_.tick_font_pt, widest = widest_row_name(frame.width(), em);
  const auto most = [&](int count) {
    return shaped(
        enough_ticks(panel_.y, limits_.y, std::max(2, count), frame.height(), kLeastUpward), theme_,
        widest);
  };
  const double for_all = height_of_names(frame.width());
  if (for_all > 0.0 && frame.height() >= for_all - 1.0)
    return most(static_cast<int>(panel_.y.names.size()));
  const auto with = [&](double row_em) {
    return most(static_cast<int>(frame.height() / (row_em * em)));
  };
  TickLabels rows = with(kNamedRow);
  const double further = further_lines_of(rows);
  return further > 0.0 ? with(kNamedRow + further) : rows;
}

FrameNumbers AxesLayout::numbers(const Axes& axes) const {
  const auto of = [](const Axis& axis, const Range& limits,
                     const Ticks& ticks) -> std::optional<AxisNumbers> {
    if (!axis.names.empty()) return std::nullopt;
    const auto label = [&](double value) { return (value - ticks.offset) / ticks.unit; };
    return AxisNumbers{axis.scale, {label(limits.low), label(limits.high)}};
  };
  if (panel_.bare) return {};
  return {of(panel_.x, limits_.x, axes.x.ticks), of(panel_.y, limits_.y, axes.y.ticks)};
}

Ticks AxesLayout::ticks_for(const Axis& axis, Range range, int most) const {
  if (!axis.names.empty()) return named_ticks(axis.names, range, most);
  if (axis.scale == Scale::kLog) return log_ticks(range.low, range.high, most);
  const double step = tick_step(range.low, range.high, most);
  return linear_ticks(range.low, range.high, axis.whole ? std::max(step, 1.0) : step);
}

/// More labels than usual where there is room for them: two do not show what the scale is.
/// @param most   As usual.
/// @param least  The least distance of two labels, in em of their text.
Ticks AxesLayout::enough_ticks(const Axis& axis, Range range, int most, double length,
                               double least) const {
  Ticks ticks = ticks_for(axis, range, most);
  const int room = static_cast<int>(length / (least * theme_.tick_font_pt));
  for (int more = most + 1; ticks.at.size() < kFewestLabels && more <= room; ++more)
    ticks = ticks_for(axis, range, more);
  return ticks;
}

void AxesLayout::choose_ticks(Axes& axes) const {
  const double em = theme_.tick_font_pt;
  const int most_y = std::clamp(static_cast<int>(axes.frame.height() / (3.2 * em)), 2, 8);
  const double per_label = panel_.x.whole ? 2.0 : 4.0;
  int most_x = std::clamp(static_cast<int>(axes.frame.width() / (per_label * em)), 2, 9);
  if (!panel_.x.names.empty())
    most_x = static_cast<int>(std::max<std::size_t>(panel_.x.names.size(), 2));
  if (panel_.equal_aspect) {
    choose_equal_ticks(axes, most_x, most_y);
  } else {
    axes.x =
        shaped(enough_ticks(panel_.x, limits_.x, most_x, axes.frame.width(), kLeastAcross), theme_);
    const int most = panel_.y.scale == Scale::kLog ? std::max(most_y, 3) : most_y;
    axes.y =
        panel_.y.names.empty()
            ? shaped(enough_ticks(panel_.y, limits_.y, most, axes.frame.height(), kLeastUpward),
                     theme_)
            : named_rows(axes.frame);
  }
  if (labels_touch(axes) && axes.x.ticks.at.size() > 2)
    axes.x = shaped(ticks_for(panel_.x, limits_.x, most_x), theme_);
  while (most_x > 2 && labels_touch(axes)) {
    axes.x = shaped(ticks_for(panel_.x, limits_.x, --most_x), theme_);
  }
  if (panel_.x.scale == Scale::kLog && labels_touch(axes))
    axes.x = shaped(three_log_ticks(limits_.x.low, limits_.x.high), theme_);
  while (axes.x.ticks.at.size() >= kFewestToHalve && labels_touch(axes, kLeastTickGap))
    axes.x = shaped(every_second(axes.x.ticks), theme_);
}

/// One step for both axes, so that the grid is of squares, unless a side then has fewer than three
/// labels and room for a step of its own.
void AxesLayout::choose_equal_ticks(Axes& axes, int most_x, int most_y) const {
  const double step = std::max(tick_step(limits_.x.low, limits_.x.high, most_x),
                               tick_step(limits_.y.low, limits_.y.high, most_y));
  const auto ticks = [&](const Axis& axis, const Range& limits, int most, double length,
                         double least) {
    Ticks shared = linear_ticks(limits.low, limits.high, step);
    if (shared.at.size() >= kFewestLabels) return shared;
    return enough_ticks(axis, limits, most, length, least);
  };
  axes.y = shaped(ticks(panel_.y, limits_.y, most_y, axes.frame.height(), kLeastUpward), theme_);
  axes.x = shaped(ticks(panel_.x, limits_.x, most_x, axes.frame.width(), kLeastAcross), theme_);
}

bool AxesLayout::labels_touch(const Axes& axes, double gap_em) const {
  const AxisMap x(panel_.x.scale, limits_.x, axes.frame.x0, axes.frame.x1);
  const double em = theme_.tick_font_pt;
  for (std::size_t i = 0; i + 1 < axes.x.texts.size(); ++i) {
    const double room = x(axes.x.ticks.at[i + 1]) - x(axes.x.ticks.at[i]);
    if ((axes.x.width(i) + axes.x.width(i + 1)) / 2.0 * em + gap_em * em > room) return true;
  }
  return false;
}

Margins AxesLayout::margins(const Axes& axes) const {
  Margins m = overhang(axes.frame);
  m.right += colour_bar_room(panel_, axes.frame.height(), theme_);
  if (panel_.bare) return m;
  const double em = theme_.tick_font_pt;
  const double y_label =
      has_y_label()
          ? 1.5 * theme_.font_pt + further_lines(upward_lines(axis_title(panel_.y, axes.y.ticks),
                                                              axes.frame.height(), theme_),
                                                 theme_.font_pt)
          : 0.0;
  const double y_ticks = axes.y.texts.empty() ? 0.0 : axes.y.widest * em + tick_gap();
  const double last = axes.x.texts.empty() ? 0.0 : axes.x.width(axes.x.texts.size() - 1) * em / 2.0;
  m.left = std::max(m.left, y_label + y_ticks + tick_length());
  m.top = std::max(m.top, 0.4 * em);
  m.right = std::max({m.right, last, theme_.hairline_pt});
  m.bottom = std::max(m.bottom, below_frame(axes));
  return m;
}

/// What further lines of the labels beside the frame take across, in points.
double AxesLayout::label_lines(const Axes& axes) const {
  const double height = axes.frame.height(), em = theme_.font_pt;
  const double of_bar = colour_bar_label_room(panel_, height, theme_);
  if (!has_y_label()) return of_bar;
  return of_bar +
         further_lines(upward_lines(axis_title(panel_.y, axes.y.ticks), height, theme_), em);
}

/// How far texts at points reach over the sides of the frame.
Margins AxesLayout::overhang(const Box& frame) const {
  Margins m;
  const PanelMap positions = map(frame);
  for (const Layer& layer : panel_.layers) {
    const auto* texts = std::get_if<Texts>(&layer);
    if (texts == nullptr) continue;
    for (std::size_t i = 0; i < texts->x.size(); ++i)
      for (const TextLine& line : placed_text(*texts, i, positions, theme_)) {
        const Box bounds = text_box(line).grown(theme_.hairline_pt);
        m.left = std::max(m.left, frame.x0 - bounds.x0);
        m.top = std::max(m.top, frame.y0 - bounds.y0);
        m.right = std::max(m.right, bounds.x1 - frame.x1);
        m.bottom = std::max(m.bottom, bounds.y1 - frame.y1);
      }
  }
  return m;
}

void AxesLayout::shrink_to_aspect(Box& frame) const {
  const double aspect = (limits_.x.high - limits_.x.low) / (limits_.y.high - limits_.y.low);
  const double width = std::min(frame.width(), frame.height() * aspect);
  const double height = width / aspect;
  frame.x1 = frame.x0 + width;
  frame.y1 = frame.y0 + height;
}

}  // namespace mapproof
