#include "render/scene/scene_figure.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/not_finite.hpp"
#include "render/base/geometry.hpp"
#include "render/plot/figure.hpp"
#include "render/plot/layout.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/scene.hpp"
#include "render/theme/font.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

/// The axes of a view as they stand in its image: lines, ticks and texts that cover each other
/// nowhere. Ticks become fewer until their labels are apart; where two axes meet, the label of the
/// second is left out if it has no room.
class RuleLayers {
 public:
  /// @param em  Height of a tick's label in the units of the image (see Projection).
  RuleLayers(const Projection& project, double em, const Font* font)
      : project_(project), em_(em), font_(font) {}

  /// The layers of one more axis; none if it is seen end on or from behind the eye.
  std::vector<Layer> add(const Rule& rule);

 private:
  struct Text {
    Point at;
    std::string text;
    Box box;
  };

  Text text_at(Point at, Point outward, double ems, Align align, const std::string& text) const;
  std::vector<Text> tick_labels(const Rule& rule, Point outward, Align align,
                                std::vector<Point>& feet, std::string& factor) const;
  bool is_free(const Box& box) const;

  const Projection& project_;
  double em_;
  const Font* font_;
  std::vector<Box> taken_;
};

// Lengths in em.
constexpr double kTick = 0.3;
constexpr double kLabelGap = 1.0;  // From the axis to the middle of its ticks' labels.
constexpr double kNameGap = 2.3;   // To the middle of its own label, at least.
constexpr double kStep = 0.2;      // In the search for its place.
constexpr double kFarthest = 12.0;
constexpr double kApart = 0.35;  // Least space between texts.

bool overlap(const Box& a, const Box& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// From the axis to its labels in the image: across the axis, on the side of `away`.
Point direction(const Rule& rule, const Projection& project) {
  const Point from = project(rule.from), to = project(rule.to);
  const Point3 middle = (rule.from + rule.to) / 2.0;
  const double step = 1e-3 * (rule.to - rule.from).norm();
  const Point a = project(middle), b = project(middle + step * rule.away.normalized());
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 1e-9)) return {kNaN, kNaN};
  Point across{-(to.y - from.y) / length, (to.x - from.x) / length};
  if (across.x * (b.x - a.x) + across.y * (b.y - a.y) < 0.0) across = {-across.x, -across.y};
  return across;
}

Align align_of(Point outward) {
  constexpr double kSlanted = 0.35;
  if (std::abs(outward.x) < kSlanted) return Align::kMiddle;
  return outward.x > 0.0 ? Align::kStart : Align::kEnd;
}

RuleLayers::Text RuleLayers::text_at(Point at, Point outward, double ems, Align align,
                                     const std::string& text) const {
  const Point position{at.x + ems * em_ * outward.x, at.y + ems * em_ * outward.y};
  const double width = shape_text(text, font_).advance * em_;
  const double before = align == Align::kStart ? 0.0 : align == Align::kMiddle ? width / 2 : width;
  const double gap = kApart / 2.0 * em_;
  const Box box{position.x - before - gap, position.y - em_ / 2.0,
                position.x - before + width + gap, position.y + em_ / 2.0};
  return {position, text, box};
}

bool RuleLayers::is_free(const Box& box) const {
  return std::ranges::none_of(taken_, [&box](const Box& other) { return overlap(box, other); });
}

/// The least step 1, 2 or 5 × 10^k with at most `most` ticks, one in a small image if two have no
/// room.
double step_within(Range range, int most) {
  double step = tick_step(range.low, range.high, most);
  while (linear_ticks(range.low, range.high, step).at.size() > static_cast<std::size_t>(most)) {
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    step *= mantissa > 1.5 && mantissa < 3.0 ? 2.5 : 2.0;
  }
  return step;
}

/// @param feet       Set to where the ticks meet the axis, as many as labels.
/// @param factor  Set to that of the ticks.
std::vector<RuleLayers::Text> RuleLayers::tick_labels(const Rule& rule, Point outward, Align align,
                                                      std::vector<Point>& feet,
                                                      std::string& factor) const {
  constexpr int kMostTicks = 6, kFewestTicks = 2;
  std::vector<Text> texts;
  for (int most = kMostTicks; most >= kFewestTicks; --most) {
    const Ticks ticks =
        linear_ticks(rule.range.low, rule.range.high, step_within(rule.range, most));
    factor = ticks.factor;
    texts.clear();
    feet.clear();
    for (std::size_t i = 0; i < ticks.at.size(); ++i) {
      const double share = (ticks.at[i] - rule.range.low) / (rule.range.high - rule.range.low);
      const Point foot = project_(rule.from + share * (rule.to - rule.from));
      if (!is_finite(foot)) continue;
      feet.push_back(foot);
      texts.push_back(text_at(foot, outward, kLabelGap, align, ticks.labels[i]));
    }
    const auto touch = [](const Text& a, const Text& b) { return overlap(a.box, b.box); };
    if (std::ranges::adjacent_find(texts, touch) == texts.end()) break;
  }
  return texts;
}

std::vector<Layer> RuleLayers::add(const Rule& rule) {
  const Point from = project_(rule.from), to = project_(rule.to);
  const Point outward = direction(rule, project_);
  if (!is_finite(from) || !is_finite(to) || !is_finite(outward)) return {};
  Polyline line{
      .x = {from.x, to.x}, .y = {from.y, to.y}, .colour = ThemeColour::kText, .width = 0.5};
  Segments marks{.colour = ThemeColour::kText, .width = 0.5};
  Texts texts{.align = align_of(outward)};
  const auto write = [&](const Text& one) {
    if (!is_free(one.box)) return false;
    taken_.push_back(one.box);
    texts.x.push_back(one.at.x);
    texts.y.push_back(one.at.y);
    texts.text.push_back(one.text);
    return true;
  };

  std::vector<Point> feet;
  std::string factor;
  for (const Text& label : tick_labels(rule, outward, texts.align, feet, factor)) write(label);
  for (const Point& foot : feet) {
    marks.x0.push_back(foot.x);
    marks.y0.push_back(foot.y);
    marks.x1.push_back(foot.x + kTick * em_ * outward.x);
    marks.y1.push_back(foot.y + kTick * em_ * outward.y);
  }
  const Point middle = project_((rule.from + rule.to) / 2.0);
  const std::string name = factor.empty() ? rule.label : rule.label + " " + factor;
  if (is_finite(middle) && !name.empty())
    for (double ems = kNameGap; ems < kFarthest; ems += kStep)
      if (write(text_at(middle, outward, ems, texts.align, name))) break;
  return {std::move(line), std::move(marks), std::move(texts)};
}

constexpr int kMostClear = 12;       // Squares along a rod.
constexpr double kRoomOfBall = 1.5;  // Of its radius: no label touches it.
constexpr int kMostOnEdge = 30;      // Along an edge of a wall.
constexpr double kLongestClear = 1.0;  // Of an image's half height, a tube that labels avoid.
constexpr double kMostEm =
    0.3;  // Of an image's half height: less puts labels of narrow paper on others.

Fill fill_of(const Style& style) {
  return style.share * style.opacity > 0.6 ? Fill::kSolid : Fill::kTint;
}

constexpr Range kOutside = {90.0, 91.0};  // Of the image: there a layer is in nobody's way.

/// A layer of one empty cell, which has the colour bar of the tones.
Layer bar(const Tones& tones) {
  return Cells{.x = kOutside,
               .y = kOutside,
               .columns = 1,
               .values = {kNaN},
               .colour_scale = {
                   .limits = tones.limits, .ramp = Ramp::kViridis, .bar_label = tones.bar_label}};
}

/// What stands for a part in the legend; its layer is empty.
class LegendLayer {
 public:
  Layer operator()(const Surface& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return swatch(part.label, part.style.colour, fill_of(part.style));
  }
  Layer operator()(const Tube& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return Polyline{.label = part.label, .colour = part.style.colour, .width = 2.0};
  }
  Layer operator()(const Rods& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    if (part.arrow)
      return Segments{.label = part.label, .colour = part.style.colour, .arrow = true};
    return swatch(part.label, part.style.colour,
                  part.style.share < 0.6 ? Fill::kTint : Fill::kSolid);
  }
  Layer operator()(const Spheres& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return Scatter{.label = part.label, .colour = part.style.colour, .size = 1.3};
  }
  Layer operator()(const Field& part) const { return ramp(part.label); }

 private:
  /// Of a pale colour with its outline, without which it cannot be seen on a dark page.
  static Layer swatch(const std::string& label, ThemeColour colour, Fill fill) {
    return Area{.label = label,
                .colour = colour,
                .fill = fill,
                .outlined = fill == Fill::kTint,
                .width = 0.6};
  }

  static Layer ramp(const std::string& label) {
    return Cells{
        .label = label, .x = kOutside, .y = kOutside, .colour_scale = {.ramp = Ramp::kViridis}};
  }
};

class ViewPanel {
 public:
  ViewPanel(const Scene& scene, std::size_t index, double em, const Font* font)
      : scene_(scene), view_(scene.views[index]), project_(view_.camera), em_(em), font_(font) {
    const double aspect = view_.camera.aspect;
    panel_.title = view_.title;
    panel_.bare = panel_.equal_aspect = true;
    panel_.x.limits = Range{-aspect, aspect};
    panel_.y.limits = Range{-1.0, 1.0};
    image_ = {.x = *panel_.x.limits, .y = *panel_.y.limits, .source = index};
  }

  Panel make() {
    for (std::size_t i = 0; i < scene_.parts.size(); ++i)
      if (shows(view_, i)) add_part(scene_.parts[i]);
    panel_.layers.insert(panel_.layers.begin(), image_);
    RuleLayers rules(project_, em_, font_);
    for (const Rule& rule : view_.rules)
      for (Layer& layer : rules.add(rule)) panel_.layers.push_back(std::move(layer));
    for (const SceneLabels& labels : view_.labels) add_association(labels);
    return std::move(panel_);
  }

 private:
  void add_part(const Part& part) {
    std::visit([this](const auto& one) { keep_clear(one); }, part);
    const Tones& tones =
        std::visit([](const auto& one) -> const Tones& { return one.tones; }, part);
    const bool named = std::visit([](const auto& one) { return !one.label.empty(); }, part);
    if (!tones.values.empty() && !tones.bar_label.empty())
      panel_.layers.push_back(bar(tones));
    else if (named)
      panel_.layers.push_back(std::visit(LegendLayer(), part));
  }

  void keep_clear(const Spheres& spheres) {
    for (const Point3& at : spheres.at) add_clear(at, kRoomOfBall * spheres.radius);
  }
  void keep_clear(const Rods& rods) {
    for (std::size_t i = 0; i < rods.from.size(); ++i) {
      const double length = (rods.to[i] - rods.from[i]).norm();
      const int pieces =
          std::clamp(static_cast<int>(std::ceil(length / (2.0 * rods.radius))), 1, kMostClear);
      for (int k = 0; k <= pieces; ++k) {
        const double share = static_cast<double>(k) / pieces;
        add_clear(rods.from[i] + share * (rods.to[i] - rods.from[i]), rods.radius);
      }
    }
  }
  /// The upper and lower edges of walls, which would strike labels through.
  void keep_clear(const Surface& surface) {
    if (!surface.style.lit || surface.smooth) return;
    for (std::size_t i = 0; i + 3 < surface.points.size(); i += 4)
      for (const std::size_t edge : {i, i + 2}) {
        const Point3 &from = surface.points[edge], &to = surface.points[edge + 1];
        const double step = (to - from).norm() / kMostOnEdge;
        for (int k = 0; k <= kMostOnEdge; ++k)
          add_clear(from + static_cast<double>(k) / kMostOnEdge * (to - from), step / 2.0);
      }
  }
  /// Labels may cover a path through all of a room, but no short piece.
  void keep_clear(const Tube& tube) {
    double length = 0.0;
    for (std::size_t i = 1; i < tube.points.size(); ++i)
      length += (tube.points[i] - tube.points[i - 1]).norm();
    if (tube.points.size() < 2 || !(length > 0.0)) return;
    if (project_.size_at(tube.points[tube.points.size() / 2], length) > kLongestClear) return;
    for (std::size_t i = 1; i < tube.points.size(); ++i)
      keep_clear(Rods{.from = {tube.points[i - 1]}, .to = {tube.points[i]}, .radius = tube.radius});
  }
  /// Labels may cover what is wide: floors, fields.
  template <typename Wide>
  void keep_clear(const Wide&) {}

  void add_clear(const Point3& at, double radius) {
    const Point p = project_(at);
    if (!is_finite(p)) return;
    image_.clear_x.push_back(p.x);
    image_.clear_y.push_back(p.y);
    image_.clear_by.push_back(project_.size_at(at, radius));
  }

  void add_association(const SceneLabels& labels) {
    PointLabels layer{.colour = labels.colour};
    for (std::size_t i = 0; i < labels.at.size(); ++i) {
      const Point p = project_(labels.at[i]);
      if (!is_finite(p)) continue;
      layer.x.push_back(p.x);
      layer.y.push_back(p.y);
      layer.text.push_back(labels.text[i]);
    }
    if (!layer.x.empty()) panel_.layers.push_back(std::move(layer));
  }

  const Scene& scene_;
  const Shot& view_;
  Projection project_;
  double em_;
  const Font* font_;
  ImageLayer image_;
  Panel panel_;
};

/// @param em  Height of a tick's label in the units of an image.
Figure figure_with(const Scene& scene, double em, const Font* font) {
  Figure figure{.id = scene.id,
                .title = scene.title,
                .caption = scene.caption,
                .alt = scene.alt,
                .record_ids = scene.record_ids,
                .varies = scene.varies,
                .notes = scene.notes,
                .panels = {},
                .columns = scene.columns};
  figure.shared_x = figure.shared_y = scene.views.size() > 1;
  for (std::size_t i = 0; i < scene.views.size(); ++i)
    figure.panels.push_back(ViewPanel(scene, i, em, font).make());
  require_valid(figure);
  return figure;
}

}  // namespace

Figure scene_figure(const Scene& scene, const Theme& theme) {
  require_valid(scene);
  // How large the images become depends on what stands around them, and that on the labels'
  // distance: three times is enough.
  double em = 2.0 * theme.tick_font_pt / theme.height_pt;
  Figure figure = figure_with(scene, em, theme.font.get());
  for (int pass = 0; pass < 2; ++pass) {
    const double height = lay_out(figure, theme).frames[0].height();
    em = std::min(kMostEm, 2.0 * theme.tick_font_pt / std::max(height, theme.tick_font_pt));
    figure = figure_with(scene, em, theme.font.get());
  }
  return figure;
}

}  // namespace mapproof
