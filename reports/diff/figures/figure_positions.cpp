#include "reports/diff/figures/figure_positions.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "render/plot/layout.hpp"

namespace mapproof {
namespace {

/// The limits of all panels; a shared axis has the common limits of all.
std::vector<PanelLimits> limits_of(const Figure& figure) {
  std::vector<PanelLimits> limits;
  for (const Panel& panel : figure.panels) limits.push_back(panel_limits(panel));
  const auto share = [&](Range PanelLimits::*axis) {
    Range all = limits[0].*axis;
    for (const PanelLimits& one : limits)
      all = {std::min(all.low, (one.*axis).low), std::max(all.high, (one.*axis).high)};
    for (PanelLimits& one : limits) one.*axis = all;
  };
  if (figure.shared_x && !limits.empty()) share(&PanelLimits::x);
  if (figure.shared_y && !limits.empty()) share(&PanelLimits::y);
  return limits;
}

std::vector<PanelMap> maps_of(const Figure& figure, const Theme& theme) {
  std::vector<PanelMap> maps;
  if (!problem(figure).empty()) return maps;
  const Drawing drawing = lay_out(figure, theme);
  const std::vector<PanelLimits> limits = limits_of(figure);
  for (std::size_t p = 0; p < figure.panels.size() && p < drawing.frames.size(); ++p) {
    const Box& frame = drawing.frames[p];
    maps.push_back({AxisMap(figure.panels[p].x.scale, limits[p].x, frame.x0, frame.x1),
                    AxisMap(figure.panels[p].y.scale, limits[p].y, frame.y1, frame.y0)});
  }
  return maps;
}

Movement along(const Axis& axis, const Range& limits, double before, double after,
               const Tolerance& tolerance) {
  if (before == after || (std::isnan(before) && std::isnan(after))) return Movement::kNone;
  if (std::isnan(before) || std::isnan(after)) return Movement::kBeyond;
  const double size =
      axis.scale == Scale::kLog ? std::abs(before) : std::abs(limits.high - limits.low);
  return std::abs(after - before) <= tolerance.absolute + tolerance.relative * size
             ? Movement::kWithin
             : Movement::kBeyond;
}

}  // namespace

FigurePositions::FigurePositions(const Figure& baseline, const Figure& current)
    : baseline_(baseline), current_(current) {
  if (problem(baseline).empty()) limits_ = limits_of(baseline);
  limits_.resize(baseline.panels.size());
}

Movement FigurePositions::movement(std::size_t panel, Point before, Point after,
                                   const Tolerance& tolerance) const {
  const Panel& axes = baseline_.panels[panel];
  return std::max(along(axes.x, limits_[panel].x, before.x, after.x, tolerance),
                  along(axes.y, limits_[panel].y, before.y, after.y, tolerance));
}

const FigurePositions::Pages& FigurePositions::pages() const {
  if (!pages_) {
    const Theme theme = report_theme();
    pages_ = {.current = maps_of(current_, theme), .px_per_pt = theme.dpi / 72.0};
  }
  return *pages_;
}

std::optional<double> FigurePositions::distance_px(std::size_t panel, Point before,
                                                   Point after) const {
  // Both on the current page: a change of the axes is not a movement of the mark.
  const Pages& page = pages();
  if (panel >= page.current.size()) return std::nullopt;
  const Point from = page.current[panel](before.x, before.y);
  const Point to = page.current[panel](after.x, after.y);
  const double distance = page.px_per_pt * std::hypot(to.x - from.x, to.y - from.y);
  return std::isfinite(distance) ? std::optional(distance) : std::nullopt;
}

}  // namespace mapproof
