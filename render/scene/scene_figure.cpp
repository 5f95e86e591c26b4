#include "render/scene/scene_figure.hpp"

#include <algorithm>
#include <cmath>

#include "render/plot/layout.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/rule_layers.hpp"

namespace mapproof {
namespace {

constexpr int kMostClear = 12;    // Squares along a rod.
constexpr double kMostEm = 0.22;  // Of a picture's half height.

Fill fill_of(const Style& style) {
  return style.share * style.opacity > 0.6 ? Fill::kSolid : Fill::kTint;
}

/// What stands for a part in the legend; its layer is empty.
class LegendLayer {
 public:
  Layer operator()(const Surface& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return Area{.label = part.label, .ink = part.style.ink, .fill = fill_of(part.style)};
  }
  Layer operator()(const Tube& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return Polyline{.label = part.label, .ink = part.style.ink, .width = 2.0};
  }
  Layer operator()(const Rods& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    if (part.arrow) return Segments{.label = part.label, .ink = part.style.ink, .arrow = true};
    const bool thin = part.style.share < 0.6;
    return Area{.label = part.label,
                .ink = part.style.ink,
                .fill = thin ? Fill::kTint : Fill::kSolid,
                .outlined = thin,
                .width = 0.6};
  }
  Layer operator()(const Spheres& part) const {
    if (!part.tones.values.empty()) return ramp(part.label);
    return Scatter{.label = part.label, .ink = part.style.ink, .size = 1.3};
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
    RuleLayers rules(project_, em_);
    for (const Rule& rule : view_.rules)
      for (Layer& layer : rules.add(rule)) panel_.layers.push_back(std::move(layer));
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
    if (!is_finite(p)) return;
    picture_.clear_x.push_back(p.x);
    picture_.clear_y.push_back(p.y);
    picture_.clear_by.push_back(project_.size_at(at, radius));
  }

  void add_labels(const SceneLabels& labels) {
    PointLabels layer{.ink = labels.ink};
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
  Picture picture_;
  Panel panel_;
};

/// @param em  Height of a tick's label in the units of a picture.
Figure figure_with(const Scene& scene, double em) {
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
    figure.panels.push_back(ViewPanel(scene, i, em).make());
  require_valid(figure);
  return figure;
}

}  // namespace

Figure scene_figure(const Scene& scene, const Theme& theme) {
  require_valid(scene);
  // How large the pictures become depends on what stands around them, and that on the labels'
  // distance: three times is enough.
  double em = 2.0 * theme.tick_font_pt / theme.height_pt;
  Figure figure = figure_with(scene, em);
  for (int pass = 0; pass < 2; ++pass) {
    const double height = lay_out(figure, theme).frames[0].height();
    em = std::min(kMostEm, 2.0 * theme.tick_font_pt / std::max(height, theme.tick_font_pt));
    figure = figure_with(scene, em);
  }
  return figure;
}

}  // namespace mapproof
