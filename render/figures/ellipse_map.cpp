#include "render/figures/ellipse_map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/words.hpp"
#include "render/plot/axis_map.hpp"

namespace mapproof {
namespace {

constexpr double kRoot_95 = 2.4477468306808166;  // Of -2 ln .05: chi-squared, 2 degrees.
constexpr double kReach = 0.15;                  // Room sides about the room that are shown.

void require_consistent(const EllipseMapSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  const auto rows = static_cast<Eigen::Index>(spec.names.size());
  if (spec.truth_m.rows() != rows) refuse("not as many true positions as names");
  if (!spec.truth_m.allFinite()) refuse("a true position is not finite");
  for (const Points& run : spec.estimates_m) {
    if (run.rows() != rows) refuse("not as many estimates as names");
    if (run.array().isInf().any()) refuse("an infinite estimate");
  }
  for (const Eigen::Index anchor : spec.anchors)
    if (anchor < 0 || anchor >= rows) refuse(fmt::format("anchor {} is no landmark", anchor));
}

/// The room, as far as landmarks show it, and some space about it.
PanelLimits limits_of(const Points& truth_m) {
  Span x, y;
  for (Eigen::Index i = 0; i < truth_m.rows(); ++i) x.see(truth_m(i, 0)), y.see(truth_m(i, 1));
  if (!x.known()) return {{0.0, 1.0}, {0.0, 1.0}};
  const double side = std::max(x.high - x.low, y.high - y.low);
  const double by = side > 0.0 ? kReach * side : 1.0;
  return {{x.low - by, x.high + by}, {y.low - by, y.high + by}};
}

}  // namespace

ScatterEllipse scatter_ellipse(const std::vector<Points>& estimates_m, Eigen::Index row) {
  ScatterEllipse ellipse;
  Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
  for (const Points& run : estimates_m)
    if (!run.row(row).hasNaN()) sum += run.row(row), ++ellipse.runs;
  ellipse.mean_m = sum / ellipse.runs;
  ellipse.a_m = ellipse.b_m = NAN;
  if (ellipse.runs < 3) return ellipse;
  Eigen::Matrix2d C = Eigen::Matrix2d::Zero();
  for (const Points& run : estimates_m) {
    if (run.row(row).hasNaN()) continue;
    const Eigen::RowVector2d off = run.row(row) - ellipse.mean_m;
    C += off.transpose() * off;
  }
  C /= ellipse.runs - 1;
  // The eigenvalues of a symmetric 2 x 2 matrix in closed form.
  const double middle = (C(0, 0) + C(1, 1)) / 2.0;
  const double half = std::hypot((C(0, 0) - C(1, 1)) / 2.0, C(0, 1));
  ellipse.a_m = kRoot_95 * std::sqrt(middle + half);
  ellipse.b_m = kRoot_95 * std::sqrt(std::max(middle - half, 0.0));
  ellipse.turn_rad = 0.5 * std::atan2(2.0 * C(0, 1), C(0, 0) - C(1, 1));
  return ellipse;
}

Figure ellipse_map_figure(const EllipseMapSpec& spec) {
  require_consistent(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  Ellipses scatter{
      .label = "95 % of estimates", .ink = Ink::kSeries1, .fill = Fill::kTint, .width = 0.6};
  Segments bias{.label = "truth to mean", .ink = Ink::kText, .width = 0.7};
  Scatter means{.label = "mean estimate", .ink = Ink::kSeries1, .size = 0.6};
  Scatter truth{.label = "true position", .ink = Ink::kText, .filled = false, .size = 0.7};
  Scatter anchors{.label = "anchor",
                  .ink = Ink::kSeries2,
                  .marker = Marker::kSquare,
                  .filled = false,
                  .size = 1.3};
  double sum_bias = 0.0, sum_a = 0.0, worst_a = 0.0;
  std::size_t placed = 0, with_ellipse = 0, outside = 0;
  std::string worst;
  const PanelLimits limits = limits_of(spec.truth_m);
  for (Eigen::Index i = 0; i < spec.truth_m.rows(); ++i) {
    const bool anchor = std::ranges::find(spec.anchors, i) != spec.anchors.end();
    add_point(anchor ? anchors : truth, point_of(spec.truth_m.row(i)));
    const ScatterEllipse e = scatter_ellipse(spec.estimates_m, i);
    if (e.runs == 0) continue;
    const std::vector<std::pair<std::string, std::string>> data = {{"landmark", spec.names[i]},
                                                                   {"runs", std::to_string(e.runs)},
                                                                   {"a", data_number(e.a_m)},
                                                                   {"b", data_number(e.b_m)}};
    const Point mean = point_of(e.mean_m);
    const double off = (e.mean_m - spec.truth_m.row(i)).norm();
    add_line(bias, point_of(spec.truth_m.row(i)), mean);
    add_point(means, mean);
    means.marks.push_back({fmt::format("mean-{}", i + 1), data});
    sum_bias += off;
    ++placed;
    outside += limits.x.low > mean.x || mean.x > limits.x.high || limits.y.low > mean.y ||
               mean.y > limits.y.high;
    if (std::isnan(e.a_m)) continue;
    scatter.x.push_back(mean.x), scatter.y.push_back(mean.y);
    scatter.a.push_back(e.a_m), scatter.b.push_back(e.b_m);
    scatter.turn_rad.push_back(e.turn_rad);
    scatter.marks.push_back({fmt::format("ellipse-{}", i + 1), data});
    sum_a += e.a_m;
    ++with_ellipse;
    if (e.a_m > worst_a) worst_a = e.a_m, worst = spec.names[i];
  }
  Panel& panel = figure.panels.emplace_back();
  panel.equal_aspect = true;
  panel.x.label = "x [m]";
  panel.y.label = "y [m]";
  panel.x.limits = limits.x;
  panel.y.limits = limits.y;
  panel.layers = {scatter, bias, truth, anchors, means};
  std::erase_if(panel.layers, is_empty);

  figure.caption = fmt::format(
      "Estimates of {} over {}: dots are means, joined to the true positions (open circles); "
      "ellipses hold 95 % of a normal scatter; squares: anchors.",
      counted(spec.names.size(), "landmark"), counted(spec.estimates_m.size(), "run"));
  figure.alt =
      fmt::format("Scatter of the estimates of {} over {}.", counted(spec.names.size(), "landmark"),
                  counted(spec.estimates_m.size(), "run"));
  if (placed > 0)
    figure.alt += fmt::format(" The means are {} m from the truth on average.",
                              significant(sum_bias / static_cast<double>(placed)));
  if (with_ellipse > 0)
    figure.alt += fmt::format(
        " Half the long axis of an ellipse is {} m on average, {} m at most, "
        "of {}.",
        significant(sum_a / static_cast<double>(with_ellipse)), significant(worst_a), worst);
  if (placed == 0) figure.notes.push_back({"No run gave a landmark a place.", Ink::kWarning});
  if (placed > 0 && with_ellipse == 0)
    figure.notes.push_back({"Fewer than three runs: no ellipses.", Ink::kWarning});
  if (outside > 0)
    figure.notes.push_back(
        {counted(outside, "mean estimate") + " outside the picture.", Ink::kWarning});
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
