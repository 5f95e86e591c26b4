#include "render/plot/mark_labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/not_finite.hpp"
#include "render/plot/outlines.hpp"
#include "render/plot/short_names.hpp"

namespace mapproof {
namespace {

constexpr int kDirections = 16;
constexpr int kRings = 14;
constexpr double kMostOfFrame = 0.35;  // Of its width, for a label.
constexpr int kMostOrders = 8;         // In which labels are tried to be placed.

struct LabelBox {
  Box box;
  bool far = false;  ///< Needs a leader.
};

/// The box of the given size whose rim touches the circle about `at` in direction `angle`.
Box beside(Point at, double radius, double angle, Point size) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const Point middle{at.x + cosine * (radius + size.x / 2.0),
                     at.y + sine * (radius + size.y / 2.0)};
  return {middle.x - size.x / 2.0, middle.y - size.y / 2.0, middle.x + size.x / 2.0,
          middle.y + size.y / 2.0};
}

Point nearest_in(const Box& box, Point p) {
  return {std::clamp(p.x, box.x0, box.x1), std::clamp(p.y, box.y0, box.y1)};
}

/// From the rim of the marker at `at` to `end`.
Shape leader_line(Point at, Point end, const Theme& theme) {
  const double length = std::hypot(end.x - at.x, end.y - at.y);
  const double rim = std::min(0.62 * theme.marker_pt, length) / std::max(length, 1e-9);
  Shape leader;
  leader.path.move_to({std::lerp(at.x, end.x, rim), std::lerp(at.y, end.y, rim)});
  leader.path.line_to(end);
  // Dotted and grey: else it would be read as a line of data, such as an error from the same mark.
  leader.stroke = Stroke{theme.of_dashed(ThemeColour::kMuted),
                         theme.hairline_pt,
                         {theme.hairline_pt, 2 * theme.hairline_pt}};
  return leader;
}

/// How many marks a leader from `at` to the box would cross; none may cross a text.
std::optional<double> leader_cost(const Box& box, Point at, const Obstacles& taken,
                                  const std::vector<Box>& texts) {
  const Point end = nearest_in(box, at);
  for (const Box& text : texts)
    if (crosses(text, at, end)) return std::nullopt;
  double cost = 0.0;
  for (const Box& other : taken.boxes)
    if (crosses(other, at, end)) cost += 1.0;
  return cost;
}

/// What a label must not cover, and where it has to stay.
struct Surroundings {
  Box frame;
  Obstacles taken;
  std::vector<Box> texts = {};

  /// Whether a label has room there: beside another text on its line that of a word space, too.
  bool has_room(const Box& box, double word_space) const {
    const auto continues = [&](const Box& text) {
      return std::abs(text.centre().y - box.centre().y) < word_space &&
             text.x0 < box.x1 + word_space && box.x0 < text.x1 + word_space;
    };
    return frame.holds(box) && !taken.hit(box) && std::ranges::none_of(texts, continues);
  }
};

/// A free box: in the innermost ring that has one the first from the right; farther out the one
/// whose leader is short and crosses few marks.
std::optional<LabelBox> find_free_box(Point at, Point size, const Surroundings& around,
                                      const Theme& theme) {
  const double near = 0.5 * theme.marker_pt + 0.4 * theme.space_pt;
  std::optional<LabelBox> best;
  double best_cost = kInfinity;
  for (int ring = 0; ring < kRings && ring < best_cost; ++ring) {
    const double radius = near + ring * 0.8 * theme.font_pt;
    for (int turn = 0; turn < kDirections; ++turn) {
      // 0, -1, 1, -2, 2, …: from the right outward to both sides.
      const int step = turn % 2 == 0 ? turn / 2 : -(turn + 1) / 2;
      const Box box = beside(at, radius, step * 2.0 * std::numbers::pi / kDirections, size);
      if (!around.has_room(box, 0.12 * theme.tick_font_pt)) continue;
      if (ring == 0) return LabelBox{box, false};
      const auto crossed = leader_cost(box, at, around.taken, around.texts);
      if (!crossed || ring + 1.5 * *crossed >= best_cost) continue;
      best_cost = ring + 1.5 * *crossed;
      best = LabelBox{box, true};
    }
  }
  return best;
}

/// The texts at points, which leaders must not cross either.
std::vector<Box> texts_in(const Panel& panel, const PanelMap& map, const Theme& theme) {
  std::vector<Box> boxes;
  for (const Layer& layer : panel.layers) {
    const auto* texts = std::get_if<Texts>(&layer);
    if (texts == nullptr) continue;
    for (std::size_t i = 0; i < texts->x.size(); ++i)
      for (const TextLine& line : placed_text(*texts, i, map, theme))
        boxes.push_back(text_box(line));
  }
  return boxes;
}

/// A label in lines.
struct LabelShape {
  std::vector<ShapedText> lines;
  Box bounds = {};  ///< Of all lines, from the start of the first one, em.
};

LabelShape stacked(std::vector<ShapedText> lines) {
  LabelShape label{std::move(lines)};
  for (std::size_t i = 0; i < label.lines.size(); ++i) {
    const Box line = label.lines[i].bounds.moved(0.0, kNameLineStep * static_cast<double>(i));
    label.bounds = i == 0 ? line : label.bounds.united(line);
  }
  return label;
}

/// How a label may be drawn, the best first: a long one whole in lines, or else elided.
std::vector<LabelShape> shapes_of(const Theme& theme, const std::string& label, double most,
                                  const std::vector<std::string>& others) {
  const ShapedText line = shape_label_within(theme, label, most, others);
  std::vector<LabelShape> shapes;
  if (is_elided(line)) shapes.push_back(stacked(name_lines(theme, label, most)));
  shapes.push_back(stacked({line}));
  return shapes;
}

/// A label without its place.
struct Label {
  Point at;  ///< What it is a label of.
  std::string text;
  ThemeColour colour;
  std::vector<LabelShape> shapes;  ///< The best first.
};

/// The labels of a panel, in order, as far as their points are drawn.
std::vector<Label> labels_in(const AxesLayout& layout, const Box& frame) {
  const Theme& theme = layout.theme();
  const PanelMap map = layout.map(frame);
  const double most = kMostOfFrame * frame.width() / theme.tick_font_pt;
  std::vector<std::string> names;
  for (const Layer& layer : layout.panel().layers)
    if (const auto* labels = std::get_if<PointLabels>(&layer))
      names.insert(names.end(), labels->text.begin(), labels->text.end());
  std::vector<Label> found;
  for (const Layer& layer : layout.panel().layers) {
    const auto* labels = std::get_if<PointLabels>(&layer);
    if (labels == nullptr) continue;
    for (std::size_t i = 0; i < labels->x.size(); ++i) {
      const Point at = map(labels->x[i], labels->y[i]);
      if (std::isnan(at.x + at.y)) continue;
      found.push_back(
          {at, labels->text[i], labels->colour, shapes_of(theme, labels->text[i], most, names)});
    }
  }
  return found;
}

/// A label and its leader, where it has been placed.
struct PlacedLabel {
  LabelShape shape;
  LabelBox place;
  std::optional<Shape> leader = {};
};

/// The first of the shapes that finds a free box.
std::optional<PlacedLabel> placed_label(const Label& label, const Surroundings& around, double gap,
                                        const Theme& theme) {
  const double em = theme.tick_font_pt;
  for (const LabelShape& shape : label.shapes) {
    const Point size{shape.bounds.width() * em + 2 * gap, shape.bounds.height() * em + 2 * gap};
    if (const auto place = find_free_box(label.at, size, around, theme))
      return PlacedLabel{shape, *place};
  }
  return std::nullopt;
}

/// Places labels one after the other. @return By label; none for one that fits nowhere.
std::vector<std::optional<PlacedLabel>> placed_in_order(const std::vector<Label>& labels,
                                                        const std::vector<std::size_t>& order,
                                                        Surroundings around, double gap,
                                                        const Theme& theme) {
  std::vector<std::optional<PlacedLabel>> placed(labels.size());
  for (const std::size_t i : order) {
    placed[i] = placed_label(labels[i], around, gap, theme);
    if (!placed[i]) continue;
    const Box& box = placed[i]->place.box;
    if (placed[i]->place.far) {
      const Point at = labels[i].at;
      placed[i]->leader = leader_line(at, nearest_in(box.grown(-0.5 * gap), at), theme);
      const std::vector<Point>& ends = placed[i]->leader->path.points;
      around.taken.lines.push_back({ends[0], ends[1], theme.hairline_pt});
    }
    around.taken.boxes.push_back(box);
    around.texts.push_back(box);
  }
  return placed;
}

/// Places labels in their order; as long as this leaves fewer of them out, those that were left out
/// are placed first.
std::vector<std::optional<PlacedLabel>> placed(const std::vector<Label>& labels,
                                               const Surroundings& around, double gap,
                                               const Theme& theme) {
  std::vector<std::size_t> order(labels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto left_out = [](const auto& all) {
    return std::ranges::count_if(all, [](const auto& one) { return !one; });
  };
  auto best = placed_in_order(labels, order, around, gap, theme);
  for (int tried = 1; tried < kMostOrders && left_out(best) > 0; ++tried) {
    std::ranges::stable_partition(order, [&](std::size_t i) { return !best[i]; });
    auto next = placed_in_order(labels, order, around, gap, theme);
    if (left_out(next) >= left_out(best)) break;
    best = std::move(next);
  }
  return best;
}

}  // namespace

void draw_mark_labels(const AxesLayout& layout, std::size_t panel_index, const Box& frame,
                      Obstacles taken, Drawing& drawing) {
  const Theme& theme = layout.theme();
  const double em = theme.tick_font_pt, gap = 0.25 * theme.space_pt;
  const Surroundings around{frame.grown(-gap), std::move(taken),
                            texts_in(layout.panel(), layout.map(frame), theme)};
  const std::vector<Label> labels = labels_in(layout, frame);
  const auto places = placed(labels, around, gap, theme);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!places[i]) continue;
    const auto& [shape, place, leader] = *places[i];
    if (leader) drawing.add(ItemClass::kLeader, panel_index, *leader).clipped = true;
    Point baseline{place.box.x0 + gap - shape.bounds.x0 * em,
                   place.box.y0 + gap - shape.bounds.y0 * em};
    for (const ShapedText& line : shape.lines) {
      drawing.add_text(ItemClass::kMarkLabel, panel_index,
                       {.shaped = line,
                        .whole = labels[i].text,
                        .at = baseline,
                        .size = em,
                        .colour = theme.of(labels[i].colour)});
      baseline.y += kNameLineStep * em;
    }
  }
}

}  // namespace mapproof
