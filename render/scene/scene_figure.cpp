#include "render/scene/scene_figure.hpp"

#include <algorithm>
#include <cmath>

#include "render/scene/projection.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

constexpr int kMostTicks = 6;
constexpr double kShareOfPage = 0.8;  // The height that the pictures of a page have, about.
constexpr int kMostClear = 12;        // Squares along a rod.

bool known(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// Height of a tick's label in the units of a picture, about.
double em_of(const Scene& scene, const Theme& theme) {
  const std::size_t most = scene.columns == 0 ? scene.views.size() : scene.columns;
  const auto columns = static_cast<double>(std::min(most, scene.views.size()));
  const double width = theme.width_pt / columns;
  const double height =
      std::min(width / scene.views[0].camera.aspect, kShareOfPage * theme.height_pt);
  return 2.0 * theme.tick_font_pt / height;
}

Fill fill_of(const Look& look) {
  return look.share * look.opacity > 0.6 ? Fill::kSolid : Fill::kTint;
}

/// What stands for a part in the legend; its layer is empty.
class LegendLayer {
 public:
  Layer operator()(const Surface& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return Area{.label = part.label, .ink = part.look.ink, .fill = fill_of(part.look)};
  }
  Layer operator()(const Tube& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return Polyline{.label = part.label, .ink = part.look.ink, .width = 2.0};
  }
  Layer operator()(const Rods& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    if (part.arrow) return Segments{.label = part.label, .ink = part.look.ink, .arrow = true};
    const bool thin = part.look.share < 0.6;
    return Area{.label = part.label,
                .ink = part.look.ink,
                .fill = thin ? Fill::kTint : Fill::kSolid,
                .outlined = thin,
                .width = 0.6};
  }
  Layer operator()(const Spheres& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return Scatter{.label = part.label, .ink = part.look.ink, .size = 1.3};
  }
  Layer operator()(const Field& part) const { return ramp(part.label); }

 private:
  /// Outside the picture, so that it is in nobody's way.
  static Layer ramp(const std::string& label) {
    constexpr Range kOutside = {90.0, 91.0};
    return Cells{.label = label, .x = kOutside, .y = kOutside, .ramp = Ramp::kViridis};
  }
};

class ViewPanel {
 public:
  ViewPanel(const Scene& scene, std::size_t index, double em)
      : scene_(scene), view_(scene.views[index]), project_(view_.camera), em_(em) {
    const double aspect = view_.camera.aspect;
    panel_.title = view_.title;
    panel_.bare = panel_.equal_aspect = true;
    panel_.x.limits = Range{-aspect, aspect};
    panel_.y.limits = Range{-1.0, 1.0};
    picture_ = {.x = *panel_.x.limits, .y = *panel_.y.limits, .source = index};
  }

  Panel make() {
    for (std::size_t i = 0; i < scene_.parts.size(); ++i)
      if (shows(view_, i)) add_part(scene_.parts[i]);
    panel_.layers.insert(panel_.layers.begin(), picture_);
    for (const Rule& rule : view_.rules) add_rule(rule);
    for (const SceneLabels& labels : view_.labels) add_labels(labels);
    return std::move(panel_);
  }

 private:
  void add_part(const Part& part) {
    std::visit([this](const auto& one) { keep_clear(one); }, part);
    const bool named = std::visit([](const auto& one) { return !one.label.empty(); }, part);
    if (named) panel_.layers.push_back(std::visit(LegendLayer(), part));
  }

  void keep_clear(const Spheres& spheres) {
    for (const Point3& at : spheres.at) add_clear(at, spheres.radius);
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
  /// Labels may cover what is wide: floors, fields, a path through all of a room.
  template <typename Wide>
  void keep_clear(const Wide&) {}

  void add_clear(const Point3& at, double radius) {
    const Point p = project_(at);
    if (!known(p)) return;
    picture_.clear_x.push_back(p.x);
    picture_.clear_y.push_back(p.y);
    picture_.clear_by.push_back(project_.size_at(at, radius));
  }

  void add_labels(const SceneLabels& labels) {
    PointLabels layer{.ink = labels.ink};
    for (std::size_t i = 0; i < labels.at.size(); ++i) {
      const Point p = project_(labels.at[i]);
      if (!known(p)) continue;
      layer.x.push_back(p.x);
      layer.y.push_back(p.y);
      layer.text.push_back(labels.text[i]);
    }
    if (!layer.x.empty()) panel_.layers.push_back(std::move(layer));
  }

  void add_rule(const Rule& rule) {
    const Point from = project_(rule.from), to = project_(rule.to);
    const Point outward = direction(rule);
    if (!known(from) || !known(to) || !known(outward)) return;
    Polyline line{.ink = Ink::kText, .width = 0.5};
    line.x = {from.x, to.x};
    line.y = {from.y, to.y};
    panel_.layers.push_back(std::move(line));

    const Ticks ticks = linear_ticks(rule.range.low, rule.range.high,
                                     tick_step(rule.range.low, rule.range.high, kMostTicks));
    Segments marks{.ink = Ink::kText, .width = 0.5};
    Texts texts{.align = align_of(outward)};
    for (std::size_t i = 0; i < ticks.at.size(); ++i) {
      const double share = (ticks.at[i] - rule.range.low) / (rule.range.high - rule.range.low);
      const Point at = project_(rule.from + share * (rule.to - rule.from));
      if (!known(at)) continue;
      marks.x0.push_back(at.x);
      marks.y0.push_back(at.y);
      marks.x1.push_back(at.x + 0.3 * em_ * outward.x);
      marks.y1.push_back(at.y + 0.3 * em_ * outward.y);
      add_text(texts, at, outward, 1.0, ticks.labels[i]);
    }
    panel_.layers.push_back(std::move(marks));
    const Point middle = project_((rule.from + rule.to) / 2.0);
    if (known(middle) && !rule.label.empty())
      add_text(texts, middle, outward, texts.align == Align::kMiddle ? 2.4 : 3.2, rule.label);
    panel_.layers.push_back(std::move(texts));
  }

  void add_text(Texts& texts, Point at, Point outward, double ems, const std::string& text) const {
    texts.x.push_back(at.x + ems * em_ * outward.x);
    texts.y.push_back(at.y + ems * em_ * outward.y);
    texts.text.push_back(text);
  }

  /// From the axis to its labels in the picture: across the axis, on the side of `away`.
  Point direction(const Rule& rule) const {
    const Point from = project_(rule.from), to = project_(rule.to);
    const Point3 middle = (rule.from + rule.to) / 2.0;
    const double step = 1e-3 * (rule.to - rule.from).norm();
    const Point a = project_(middle), b = project_(middle + step * rule.away.normalized());
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 1e-9)) return {NAN, NAN};
    Point across{-(to.y - from.y) / length, (to.x - from.x) / length};
    if (across.x * (b.x - a.x) + across.y * (b.y - a.y) < 0.0) across = {-across.x, -across.y};
    return across;
  }

  static Align align_of(Point outward) {
    constexpr double kSlanted = 0.35;
    if (std::abs(outward.x) < kSlanted) return Align::kMiddle;
    return outward.x > 0.0 ? Align::kStart : Align::kEnd;
  }

  const Scene& scene_;
  const Shot& view_;
  Projection project_;
  double em_;
  Picture picture_;
  Panel panel_;
};

}  // namespace

Figure scene_figure(const Scene& scene, const Theme& theme) {
  require_valid(scene);
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
  const double em = em_of(scene, theme);
  for (std::size_t i = 0; i < scene.views.size(); ++i)
    figure.panels.push_back(ViewPanel(scene, i, em).make());
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
