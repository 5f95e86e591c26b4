#include "render/figures/maps/scatter_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/maps/covariance_ellipse.hpp"
#include "render/figures/maps/ellipse_frame.hpp"
#include "render/plot/axis_map.hpp"

namespace mapproof {
namespace {

constexpr double kRoomReach = 0.15;  // Room sides about the room that are shown.

void require_consistent(const EllipseMapSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  const auto rows = static_cast<Eigen::Index>(spec.names.size());
  if (spec.ground_truth_m.rows() != rows) refuse("not as many true positions as names");
  if (!spec.ground_truth_m.allFinite()) refuse("a true position is not finite");
  for (const Points& run : spec.estimates_m) {
    if (run.rows() != rows) refuse("not as many estimates as names");
    if (run.array().isInf().any()) refuse("an infinite estimate");
  }
  for (const Eigen::Index anchor : spec.anchors)
    if (anchor < 0 || anchor >= rows) refuse(fmt::format("anchor {} is not a landmark", anchor));
}

/// The room, as far as landmarks show it, and some space about it.
PanelLimits limits_of(const Points& ground_truth_m) {
  Span x, y;
  for (Eigen::Index i = 0; i < ground_truth_m.rows(); ++i)
    x.see(ground_truth_m(i, 0)), y.see(ground_truth_m(i, 1));
  if (!x.known()) return {{0.0, 1.0}, {0.0, 1.0}};
  const double side = std::max(x.high - x.low, y.high - y.low);
  const double by = side > 0.0 ? kRoomReach * side : 1.0;
  return {{x.low - by, x.high + by}, {y.low - by, y.high + by}};
}

bool is_outside(const PanelLimits& limits, Point p) {
  return limits.x.low > p.x || p.x > limits.x.high || limits.y.low > p.y || p.y > limits.y.high;
}

/// What is drawn, landmark by landmark.
struct EllipseLayers {
  Ellipses scatter{.label = "95 % of estimates",
                   .colour = ThemeColour::kSeries1,
                   .fill = Fill::kTint,
                   .width = 0.6};
  Segments spokes{.colour = ThemeColour::kSeries1, .width = 0.4};
  Scatter estimates{.label = "single estimate", .colour = ThemeColour::kSeries1, .size = 0.35};
  Segments bias{.label = "error of the mean", .colour = ThemeColour::kText, .width = 0.7};
  Scatter means{.label = "mean estimate", .colour = ThemeColour::kSeries1, .size = 0.6};
  Scatter ground_truth{
      .label = "true position", .colour = ThemeColour::kText, .filled = false, .size = 0.7};
  Scatter anchors{.label = "anchor",
                  .colour = ThemeColour::kSeries2,
                  .marker = Marker::kSquare,
                  .filled = false,
                  .size = 1.3};

  void add(const EllipseMapSpec& spec, Eigen::Index i, const ScatterEllipse& e) {
    const bool anchor = std::ranges::find(spec.anchors, i) != spec.anchors.end();
    const Point at = point_of(spec.ground_truth_m.row(i));
    add_point(anchor ? anchors : ground_truth, at);
    if (e.runs == 0) return;
    const std::vector<std::pair<std::string, std::string>> data = {{"landmark", spec.names[i]},
                                                                   {"runs", std::to_string(e.runs)},
                                                                   {"a", data_number(e.a_m)},
                                                                   {"b", data_number(e.b_m)}};
    const Point mean = point_of(e.mean_m);
    add_line(bias, at, mean);
    add_point(means, mean);
    means.marks.push_back({fmt::format("mean-{}", i + 1), data});
    if (std::isnan(e.a_m)) {
      add_estimates(spec, i, mean);
      return;
    }
    scatter.x.push_back(mean.x), scatter.y.push_back(mean.y);
    scatter.a.push_back(e.a_m), scatter.b.push_back(e.b_m);
    scatter.rotation_rad.push_back(e.rotation_rad);
    scatter.marks.push_back({fmt::format("ellipse-{}", i + 1), data});
  }

  /// One estimate is its own mean.
  void add_estimates(const EllipseMapSpec& spec, Eigen::Index i, Point mean) {
    for (std::size_t run = 0; run < spec.estimates_m.size(); ++run) {
      const auto row = spec.estimates_m[run].row(i);
      if (row.hasNaN() || point_of(row) == mean) continue;
      add_line(spokes, mean, point_of(row));
      add_point(estimates, point_of(row));
      estimates.marks.push_back(
          {"", {{"landmark", spec.names[i]}, {"run", std::to_string(run + 1)}}});
    }
  }

  /// Ellipses, and estimates as discs without a size.
  Ellipses shapes() const {
    Ellipses all = scatter;
    for (std::size_t k = 0; k < estimates.x.size(); ++k)
      add_disc(all, {estimates.x[k], estimates.y[k]}, 0.0);
    return all;
  }
};

/// How far the estimates of a landmark are from their mean [m].
std::vector<double> distances_from_mean(const EllipseMapSpec& spec, Eigen::Index i,
                                        const ScatterEllipse& e) {
  std::vector<double> distances_m;
  for (const Points& run : spec.estimates_m)
    if (!run.row(i).hasNaN()) distances_m.push_back((run.row(i) - e.mean_m).norm());
  return distances_m;
}

/// What the text reports.
struct EllipseSummary {
  std::size_t placed = 0;        ///< Landmarks with a mean.
  std::size_t with_ellipse = 0;  ///< With kFewestForEllipse runs or more.
  std::size_t estimates = 0;     ///< Of landmarks without an ellipse.
  double sum_distance_m = 0.0;   ///< Of those from their mean.
  std::size_t outside = 0;       ///< Means outside the image.
  double sum_bias_m = 0.0;       ///< Over those placed.
  double sum_a_m = 0.0;          ///< Over those with an ellipse.
  double worst_a_m = 0.0;
  std::string worst;  ///< The first with the longest axis.

  void add(const EllipseMapSpec& spec, Eigen::Index i, const ScatterEllipse& e,
           const PanelLimits& limits) {
    if (e.runs == 0) return;
    ++placed;
    sum_bias_m += (e.mean_m - spec.ground_truth_m.row(i)).norm();
    outside += is_outside(limits, point_of(e.mean_m));
    if (std::isnan(e.a_m)) {
      for (const double distance_m : distances_from_mean(spec, i, e))
        ++estimates, sum_distance_m += distance_m;
      return;
    }
    ++with_ellipse;
    sum_a_m += e.a_m;
    if (with_ellipse == 1 || e.a_m > worst_a_m) worst_a_m = e.a_m, worst = spec.names[i];
  }
};

std::string alt_of(const EllipseMapSpec& spec, const EllipseSummary& summary) {
  std::string text =
      fmt::format("Scatter of the estimates of {} over {}.", counted(spec.names.size(), "landmark"),
                  counted(spec.estimates_m.size(), "run"));
  if (summary.placed > 0)
    text += fmt::format(" The means are {} m from the ground truth on average.",
                        significant(summary.sum_bias_m / static_cast<double>(summary.placed)));
  if (summary.with_ellipse > 0)
    text +=
        fmt::format(" Half the long axis of an ellipse is {} m on average, {} m at most, of {}.",
                    significant(summary.sum_a_m / static_cast<double>(summary.with_ellipse)),
                    significant(summary.worst_a_m), summary.worst);
  else if (spec.estimates_m.size() > 1 && summary.estimates > 0)
    text +=
        fmt::format(" The estimates are {} m from their mean on average.",
                    significant(summary.sum_distance_m / static_cast<double>(summary.estimates)));
  return text;
}

/// @param estimates  Those drawn one by one.
std::vector<Note> notes_of(const EllipseSummary& summary, const Scatter& estimates,
                           const PanelLimits& limits) {
  std::vector<Note> notes;
  if (summary.placed == 0)
    notes.push_back({"No run gave a landmark a position.", ThemeColour::kWarning});
  if (summary.outside > 0)
    notes.push_back(
        {counted(summary.outside, "mean estimate") + " outside the image.", ThemeColour::kWarning});
  std::size_t outside = 0;
  for (std::size_t k = 0; k < estimates.x.size(); ++k)
    outside += is_outside(limits, {estimates.x[k], estimates.y[k]});
  if (outside > 0)
    notes.push_back(
        {counted(outside, "single estimate") + " outside the image.", ThemeColour::kWarning});
  return notes;
}

/// What the points and lines are.
std::string caption_of(const EllipseMapSpec& spec, const EllipseLayers& layers) {
  return fmt::format(
      "Estimates of {} over {}: dots are means, joined to the true positions (open circles){}{}; "
      "squares: anchors.",
      counted(spec.names.size(), "landmark"), counted(spec.estimates_m.size(), "run"),
      is_empty(layers.scatter) ? "" : "; ellipses hold 95 % of a normal scatter",
      is_empty(layers.estimates)
          ? ""
          : fmt::format("; small dots are single estimates, joined to their mean: fewer than {} "
                        "are too few for an ellipse",
                        kFewestForEllipse));
}

}  // namespace

ScatterEllipse scatter_ellipse(const std::vector<Points>& estimates_m, Eigen::Index row) {
  ScatterEllipse ellipse;
  Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
  for (const Points& run : estimates_m)
    if (!run.row(row).hasNaN()) sum += run.row(row), ++ellipse.runs;
  ellipse.mean_m = sum / ellipse.runs;
  ellipse.a_m = ellipse.b_m = kNaN;
  if (ellipse.runs < kFewestForEllipse) return ellipse;
  Eigen::Matrix2d C = Eigen::Matrix2d::Zero();
  for (const Points& run : estimates_m) {
    if (run.row(row).hasNaN()) continue;
    const Eigen::RowVector2d off = run.row(row) - ellipse.mean_m;
    C += off.transpose() * off;
  }
  C /= ellipse.runs - 1;
  const Ellipse axes = covariance_ellipse(C);
  ellipse.a_m = axes.a, ellipse.b_m = axes.b, ellipse.rotation_rad = axes.rotation_rad;
  return ellipse;
}

std::string scatter_finding(const EllipseMapSpec& spec) {
  struct Means {
    double bias_m = 0.0, reach_m = 0.0;
    int landmarks = 0;

    void see(double bias, double reach) { bias_m += bias, reach_m += reach, ++landmarks; }
  };
  Means ellipses, estimates;
  for (Eigen::Index i = 0; i < spec.ground_truth_m.rows(); ++i) {
    if (std::ranges::find(spec.anchors, i) != spec.anchors.end()) continue;
    const ScatterEllipse ellipse = scatter_ellipse(spec.estimates_m, i);
    if (ellipse.runs < 2) continue;
    const double bias_m = (ellipse.mean_m - spec.ground_truth_m.row(i)).norm();
    if (std::isfinite(ellipse.a_m)) ellipses.see(bias_m, ellipse.a_m);
    const std::vector<double> from_mean_m = distances_from_mean(spec, i, ellipse);
    estimates.see(bias_m, std::reduce(from_mean_m.begin(), from_mean_m.end()) / ellipse.runs);
  }
  if (ellipses.landmarks > 0)
    return fmt::format("mean positions {} off, 95\u00A0% ellipses of {} (half the long axis)",
                       error_text(ellipses.bias_m / ellipses.landmarks),
                       error_text(ellipses.reach_m / ellipses.landmarks));
  if (estimates.landmarks == 0) return "";
  return fmt::format("mean positions {} off, estimates {} from their mean",
                     error_text(estimates.bias_m / estimates.landmarks),
                     error_text(estimates.reach_m / estimates.landmarks));
}

Figure ellipse_map_figure(const EllipseMapSpec& spec) {
  require_consistent(spec);
  EllipseLayers layers;
  std::vector<ScatterEllipse> ellipses;
  for (Eigen::Index i = 0; i < spec.ground_truth_m.rows(); ++i) {
    ellipses.push_back(scatter_ellipse(spec.estimates_m, i));
    layers.add(spec, i, ellipses.back());
  }
  const PanelLimits limits = with_ellipses(limits_of(spec.ground_truth_m), layers.shapes());
  EllipseSummary summary;
  for (Eigen::Index i = 0; i < spec.ground_truth_m.rows(); ++i)
    summary.add(spec, i, ellipses[static_cast<std::size_t>(i)], limits);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  Panel& panel = figure.panels.emplace_back();
  panel.equal_aspect = true;
  panel.x.label = "x [m]";
  panel.y.label = "y [m]";
  panel.x.limits = limits.x;
  panel.y.limits = limits.y;
  panel.layers = {layers.scatter,      layers.spokes,  layers.estimates, layers.bias,
                  layers.ground_truth, layers.anchors, layers.means};
  std::erase_if(panel.layers, is_empty);
  figure.caption = caption_of(spec, layers);
  figure.alt = alt_of(spec, summary);
  figure.notes = notes_of(summary, layers.estimates, limits);
  if (auto note = cut_ellipses_note(layers.scatter, limits, " m"))
    figure.notes.push_back(*std::move(note));
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
