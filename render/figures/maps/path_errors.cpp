#include "render/figures/maps/path_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/thinning.hpp"
#include "render/figures/unit_scale.hpp"

namespace mapproof {
namespace {

constexpr int kCurveBins = 200;
/// In which medians are taken, where a curve of all poses would be a barcode: a panel of 250 points
/// of width has three for each.
constexpr int kMedianBins = 80;
/// Of a path on a map: at 500 points of width a piece is shorter than its line is wide.
constexpr Eigen::Index kMostPieces = 2000;
constexpr double kPathWidth = 1.6;  // Lines of the theme.
constexpr std::array kAxisNames = {"x", "y", "z"};

void check(const PathErrorsSpec& spec) {
  if (spec.lines.empty())
    throw InvalidInput("figure " + printable(spec.id) + ": errors of poses need a path");
  for (const PathErrorLine& line : spec.lines)
    if (line.poses == nullptr || line.poses->size() == 0)
      throw InvalidInput("figure " + printable(spec.id) + ": a path without poses");
}

double root_mean_square(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

double median_of(const Eigen::VectorXd& errors_m) {
  return median(std::span(errors_m.data(), static_cast<std::size_t>(errors_m.size())));
}

double greatest_of(const PathErrorsSpec& spec) {
  double greatest_m = 0.0;
  for (const PathErrorLine& line : spec.lines)
    greatest_m = std::max(greatest_m, line.poses->error_m.maxCoeff());
  return greatest_m;
}

/// The unit of all errors of a figure.
ScaledUnit unit_of(const PathErrorsSpec& spec) { return scaled_unit("m", greatest_of(spec)); }

std::string in_unit(double error_m, const ScaledUnit& unit) {
  return quantity_text(unit.factor * error_m, unit.unit);
}

std::string numbers_of(const PathErrorsSpec& spec) {
  const ScaledUnit unit = unit_of(spec);
  std::string text;
  for (const PathErrorLine& line : spec.lines) {
    const Eigen::VectorXd& errors_m = line.poses->error_m;
    text += fmt::format(" {}: {}, RMSE {}, median {}, greatest {}.", line.label,
                        counted(errors_m.size(), "pose"), in_unit(root_mean_square(errors_m), unit),
                        in_unit(median_of(errors_m), unit), in_unit(errors_m.maxCoeff(), unit));
  }
  return text;
}

Figure figure_of(const PathErrorsSpec& spec, std::string caption) {
  check(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.caption = std::move(caption);
  figure.alt = figure.caption + numbers_of(spec);
  return figure;
}

/// The two axes along which the ground truth extends most.
std::pair<Eigen::Index, Eigen::Index> plane_of(const PathErrorsSpec& spec) {
  Eigen::RowVector3d span = Eigen::RowVector3d::Zero();
  for (const PathErrorLine& line : spec.lines) {
    for (const SpacePoints* path :
         {&line.poses->ground_truth_m, &line.poses->ground_truth_alone.positions_m})
      if (path->rows() > 0)
        span = span.cwiseMax(path->colwise().maxCoeff() - path->colwise().minCoeff());
  }
  Eigen::Index least = 0;
  for (Eigen::Index i = 1; i < 3; ++i)
    if (span(i) <= span(least)) least = i;
  return {least == 0 ? 1 : 0, least == 2 ? 1 : 2};
}

/// Longer ways between two poses are a gap in what was associated.
double longest_way(const PoseErrors& poses) {
  std::vector<double> ways_m;
  for (Eigen::Index i = 1; i < poses.size(); ++i)
    ways_m.push_back(poses.distance_m(i) - poses.distance_m(i - 1));
  constexpr double kManyTimes = 10.0;
  return ways_m.empty() ? 0.0 : kManyTimes * std::max(upper_median(std::move(ways_m)), 1e-12);
}

/// Some of the poses: of those in one of kMostPieces equal pieces of the way the one with the
/// greatest error, or all if there are no more than that. None (-1) stands in a gap.
std::vector<Eigen::Index> shown_poses(const PoseErrors& poses) {
  const double longest_m = longest_way(poses);
  const double piece_m = poses.distance_m(poses.size() - 1) / kMostPieces;
  std::vector<Eigen::Index> shown = {0};
  for (Eigen::Index i = 1; i < poses.size(); ++i) {
    if (poses.distance_m(i) - poses.distance_m(i - 1) > longest_m)
      shown.insert(shown.end(), {-1, i});
    else if (poses.size() <= kMostPieces ||
             std::floor(poses.distance_m(i) / piece_m) >
                 std::floor(poses.distance_m(shown.back()) / piece_m))
      shown.push_back(i);
    else if (poses.error_m(i) > poses.error_m(shown.back()))
      shown.back() = i;
  }
  return shown;
}

/// A position of a path, of a pose that is associated or alone.
struct PathPoint {
  double time_s = 0.0;
  Eigen::RowVector3d position_m;
  bool is_alone = false;
};

/// Of the associated poses and those alone, by time.
std::vector<PathPoint> points_of(const PoseErrors& poses, const SpacePoints& associated_m,
                                 const LonePoses& alone) {
  std::vector<PathPoint> points;
  for (Eigen::Index i = 0; i < poses.size(); ++i)
    points.push_back({poses.time_s(i), associated_m.row(i)});
  for (Eigen::Index i = 0; i < alone.time_s.size(); ++i)
    points.push_back({alone.time_s(i), alone.positions_m.row(i), true});
  std::ranges::stable_sort(points, {}, &PathPoint::time_s);
  return points;
}

void add_break(Polyline& line) {
  line.x.push_back(kNaN);
  line.y.push_back(kNaN);
}

/// The ground truth, also where no pose of the estimate is associated: a gap is then seen to be
/// one of the estimate. It is broken where it has no poses of its own.
/// @param shown  As of shown_poses().
void add_ground_truth(const PoseErrors& poses, const std::vector<Eigen::Index>& shown,
                      std::pair<Eigen::Index, Eigen::Index> plane, Polyline& line) {
  const LonePoses& alone = poses.ground_truth_alone;
  const auto add = [&](const Eigen::RowVector3d& position) {
    line.x.push_back(position(plane.first));
    line.y.push_back(position(plane.second));
  };
  if (alone.time_s.size() == 0) {
    for (const Eigen::Index i : shown) i < 0 ? add_break(line) : add(poses.ground_truth_m.row(i));
    return;
  }
  const double longest_s = std::max(longest_step(poses.time_s),
                                    alone.time_s.size() > 1 ? longest_step(alone.time_s) : 0.0);
  double last_s = kInfinity;
  const std::vector<PathPoint> points = points_of(poses, poses.ground_truth_m, alone);
  const std::size_t stride = 1 + points.size() / (2 * kMostPieces);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_gap = points[i].time_s - last_s > longest_s;
    last_s = points[i].time_s;
    if (is_gap) add_break(line);
    if (is_gap || i % stride == 0 || i + 1 == points.size()) add(points[i].position_m);
  }
}

/// The estimate where it has no ground truth, from the associated pose before it to the one behind:
/// the drive is then seen to go on. Short pauses between associated poses are none.
Polyline lone_estimate(const PoseErrors& poses, std::pair<Eigen::Index, Eigen::Index> plane) {
  Polyline line{.label = "without ground truth",
                .colour = ThemeColour::kMuted,
                .dash = Dash::kDotted,
                .width = 0.8};
  const LonePoses& alone = poses.estimate_alone;
  if (alone.time_s.size() == 0) return line;
  const std::vector<PathPoint> points = points_of(poses, poses.estimate_m, alone);
  const double longest_s = longest_step(poses.time_s);
  const auto is_associated = [](const PathPoint& point) { return !point.is_alone; };
  for (auto at = points.begin(); at != points.end();) {
    const auto first = std::find_if_not(at, points.end(), is_associated);
    const auto last = std::find_if(first, points.end(), is_associated);
    const auto from = first == points.begin() ? first : first - 1;
    const auto to = last == points.end() ? last : last + 1;
    if (first != last && (to - 1)->time_s - from->time_s > longest_s) {
      if (!line.x.empty()) add_break(line);
      for (auto point = from; point != to; ++point) {
        line.x.push_back(point->position_m(plane.first));
        line.y.push_back(point->position_m(plane.second));
      }
    }
    at = last;
  }
  return line;
}

Panel map_panel(const PathErrorLine& line, std::pair<Eigen::Index, Eigen::Index> plane,
                double greatest_m, const ScaledUnit& unit) {
  const PoseErrors& poses = *line.poses;
  Polyline ground_truth{.label = "ground truth", .colour = ThemeColour::kMuted, .width = 0.6};
  Polyline estimate{.label = "estimate", .width = kPathWidth};
  estimate.mark = {.id = "errors", .data = {{"method", line.label}}};
  estimate.colour_scale = {.limits = {0.0, greatest_m > 0.0 ? unit.factor * greatest_m : 1.0},
                           .ramp = Ramp::kViridis,
                           .bar_label = fmt::format("error [{}]", unit.unit)};
  const std::vector<Eigen::Index> shown = shown_poses(poses);
  add_ground_truth(poses, shown, plane, ground_truth);
  for (const Eigen::Index i : shown) {
    estimate.x.push_back(i < 0 ? kNaN : poses.estimate_m(i, plane.first));
    estimate.y.push_back(i < 0 ? kNaN : poses.estimate_m(i, plane.second));
    estimate.values.push_back(i < 0 ? kNaN : unit.factor * poses.error_m(i));
  }
  Panel panel;
  panel.x.label = fmt::format("{} [m]", kAxisNames[static_cast<std::size_t>(plane.first)]);
  panel.y.label = fmt::format("{} [m]", kAxisNames[static_cast<std::size_t>(plane.second)]);
  panel.equal_aspect = true;
  panel.layers.emplace_back(std::move(ground_truth));
  Polyline alone = lone_estimate(poses, plane);
  if (!alone.x.empty()) panel.layers.emplace_back(std::move(alone));
  panel.layers.emplace_back(std::move(estimate));
  return panel;
}

/// The poses, by their numbers, and -1 where none are associated for longer than usual.
std::vector<Eigen::Index> poses_and_pauses(const PoseErrors& poses) {
  const double longest_s = poses.has_times ? longest_step(poses.time_s) : kInfinity;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < poses.size(); ++i) {
    if (i > 0 && poses.time_s(i) - poses.time_s(i - 1) > longest_s) rows.push_back(-1);
    rows.push_back(i);
  }
  return rows;
}

bool has_pauses(const PathErrorsSpec& spec) {
  return std::ranges::any_of(spec.lines, [](const PathErrorLine& line) {
    return std::cmp_greater(poses_and_pauses(*line.poses).size(), line.poses->size());
  });
}

/// Whether medians are shown in place of its single errors.
bool has_medians(const PathErrorLine& line) { return line.poses->size() >= 2 * kMedianBins; }

/// The errors of single poses behind their medians if there are enough, else alone.
void add_curves(const PathErrorLine& line, const Eigen::VectorXd& over, const ScaledUnit& unit,
                Panel& panel) {
  const std::string label =
      fmt::format("{}, RMSE {}", line.label, in_unit(root_mean_square(line.poses->error_m), unit));
  std::vector<double> x, errors;
  for (const Eigen::Index i : poses_and_pauses(*line.poses)) {
    x.push_back(i < 0 ? x.back() : over(i));
    errors.push_back(i < 0 ? kNaN : unit.factor * line.poses->error_m(i));
  }
  const Eigen::Map<const Eigen::VectorXd> at(x.data(), std::ssize(x));
  ThinLine thin = thin_curve(at, errors, kCurveBins);
  if (has_medians(line)) {
    // Below the lines of all systems.
    const auto first_line = std::ranges::find_if(panel.layers, [](const Layer& layer) {
      return std::get<Polyline>(layer).colour != ThemeColour::kMuted;
    });
    panel.layers.insert(first_line, Polyline{.label = "single poses",
                                             .x = std::move(thin.x),
                                             .y = std::move(thin.y),
                                             .colour = ThemeColour::kMuted,
                                             .width = 0.3,
                                             .mark = {"", {{"kind", "single poses"}}}});
    thin = median_curve(at, errors, kMedianBins);
  }
  const SeriesStyle style = series_style(line.series);
  panel.layers.emplace_back(Polyline{.label = label,
                                     .x = std::move(thin.x),
                                     .y = std::move(thin.y),
                                     .colour = style.colour,
                                     .dash = style.dash,
                                     .width = has_medians(line) ? 1.0 : 0.7,
                                     .mark = {"", {{"curve", label}}}});
}

std::string median_words(const PathErrorsSpec& spec, std::string_view over) {
  if (std::ranges::none_of(spec.lines, has_medians)) return "";
  return fmt::format(
      " Lines: the median in each of {} equal pieces of {} and of the way; behind them the errors "
      "of single poses.{}",
      kMedianBins, over,
      std::ranges::all_of(spec.lines, has_medians)
          ? ""
          : fmt::format(" A line of fewer than {} poses shows their errors themselves.",
                        2 * kMedianBins));
}

/// The share of values at or below each, at most so many points.
Polyline distribution_of(const PathErrorLine& line, const Eigen::VectorXd& errors) {
  std::vector<double> sorted(errors.begin(), errors.end());
  std::ranges::sort(sorted);
  const SeriesStyle style = series_style(line.series);
  Polyline curve{.label = line.label,
                 .colour = style.colour,
                 .dash = style.dash,
                 .mark = {"", {{"method", line.label}}}};
  const std::size_t n = sorted.size(), points = std::min<std::size_t>(n, 2 * kCurveBins);
  curve.x.push_back(sorted.front());
  curve.y.push_back(0.0);
  for (std::size_t k = 1; k <= points; ++k) {
    const std::size_t rank = (k * n + points - 1) / points;  // From 1 to n.
    curve.x.push_back(sorted[rank - 1]);
    curve.y.push_back(100.0 * static_cast<double>(rank) / static_cast<double>(n));
  }
  return curve;
}

}  // namespace

Figure path_error_map_figure(const PathErrorsSpec& spec, std::size_t shown) {
  check(spec);
  if (shown >= spec.lines.size())
    throw InvalidInput("figure " + printable(spec.id) + ": there is no such path");
  const auto plane = plane_of(spec);
  PathErrorsSpec one = spec;
  one.lines = {spec.lines[shown]};
  Figure figure = figure_of(
      one, fmt::format("The aligned estimate, coloured by the position error; grey: the "
                       "ground truth. RMSE: {}.",
                       in_unit(root_mean_square(spec.lines[shown].poses->error_m), unit_of(spec))));
  figure.panels.push_back(map_panel(spec.lines[shown], plane, greatest_of(spec), unit_of(spec)));
  constexpr std::size_t kLayersOfWhole = 2;
  if (figure.panels.front().layers.size() > kLayersOfWhole)
    figure.caption += " Dotted: the estimate where no ground truth is known.";
  require_valid(figure);
  return figure;
}

Figure path_error_curves_figure(const PathErrorsSpec& spec) {
  check(spec);
  const bool has_times = spec.lines.front().poses->has_times;
  Figure figure = figure_of(
      spec, fmt::format("Position error of each pose over {} and over the way along the "
                        "ground truth.{}{}",
                        has_times ? "time" : "the number of the pose",
                        median_words(spec, has_times ? "the time" : "the poses"),
                        has_pauses(spec) ? " Lines are broken where no pose is associated "
                                           "for more than ten usual steps of time."
                                         : ""));
  const ScaledUnit unit = unit_of(spec);
  Panel over_time, over_way;
  over_time.x.label = has_times ? "time [s]" : "pose";
  over_way.x.label = "way [m]";
  double first_s = HUGE_VAL;
  for (const PathErrorLine& line : spec.lines)
    first_s = std::min(first_s, has_times ? line.poses->time_s(0) : 0.0);
  for (const PathErrorLine& line : spec.lines) {
    add_curves(line, line.poses->time_s.array() - first_s, unit, over_time);
    add_curves(line, line.poses->distance_m, unit, over_way);
  }
  for (Panel* panel : {&over_time, &over_way}) {
    panel->y.label = fmt::format("error [{}]", unit.unit);
    figure.panels.push_back(std::move(*panel));
  }
  figure.shared_y = true;
  const double greatest = unit.factor * greatest_of(spec);
  for (Panel& panel : figure.panels)
    panel.y.limits = Range{0.0, greatest > 0.0 ? 1.05 * greatest : 1.0};
  require_valid(figure);
  return figure;
}

Figure path_error_distribution_figure(const PathErrorsSpec& spec) {
  Figure figure = figure_of(spec, "Lines: the share of poses whose error is at or below a value.");
  const ScaledUnit unit = unit_of(spec);
  Panel positions;
  positions.x.label = fmt::format("position error [{}]", unit.unit);
  for (const PathErrorLine& line : spec.lines)
    positions.layers.emplace_back(distribution_of(line, unit.factor * line.poses->error_m));
  figure.panels.push_back(std::move(positions));
  const bool has_angles = std::ranges::all_of(
      spec.lines, [](const PathErrorLine& line) { return line.poses->error_deg.size() > 0; });
  if (has_angles) {
    Panel angles;
    angles.x.label = "orientation error [°]";
    for (const PathErrorLine& line : spec.lines)
      angles.layers.emplace_back(distribution_of(line, line.poses->error_deg));
    figure.panels.push_back(std::move(angles));
  }
  for (Panel& panel : figure.panels)
    panel.y = {.label = "poses at or below [%]", .limits = Range{0.0, 103.0}};
  figure.shared_y = figure.panels.size() > 1;
  require_valid(figure);
  return figure;
}

std::string path_error_finding(const PathErrorsSpec& spec, std::size_t shown) {
  check(spec);
  const ScaledUnit unit = unit_of(spec);
  const PathErrorLine& line = spec.lines.at(shown);
  return fmt::format("{} errs by {} (RMSE), {} at most", line.label,
                     in_unit(root_mean_square(line.poses->error_m), unit),
                     in_unit(line.poses->error_m.maxCoeff(), unit));
}

std::string path_errors_finding(const PathErrorsSpec& spec) {
  check(spec);
  const auto rmse_of = [](const PathErrorLine& line) {
    return root_mean_square(line.poses->error_m);
  };
  const auto best = std::ranges::min_element(spec.lines, {}, rmse_of);
  if (spec.lines.size() == 1) return path_error_finding(spec, 0);
  double next = kInfinity;
  for (const PathErrorLine& line : spec.lines)
    if (&line != &*best) next = std::min(next, rmse_of(line));
  return fmt::format("{} has the lowest RMSE, {}; the {} has {}", best->label,
                     in_unit(rmse_of(*best), unit_of(spec)),
                     spec.lines.size() == 2 ? "other" : "next", in_unit(next, unit_of(spec)));
}

std::string path_medians_finding(const PathErrorsSpec& spec) {
  check(spec);
  constexpr std::size_t kMostLines = 3;
  const ScaledUnit unit = unit_of(spec);
  std::vector<const PathErrorLine*> lines;
  for (const PathErrorLine& line : spec.lines) lines.push_back(&line);
  const auto median_error = [](const PathErrorLine* line) {
    return median_of(line->poses->error_m);
  };
  std::ranges::stable_sort(lines, {}, median_error);
  if (lines.size() > kMostLines)
    return fmt::format("half of the poses err by less than {} with {}, {} with {}",
                       in_unit(median_error(lines.front()), unit), lines.front()->label,
                       in_unit(median_error(lines.back()), unit), lines.back()->label);
  std::vector<std::string> words;
  for (const PathErrorLine* line : lines)
    words.push_back(fmt::format("{} with {}", in_unit(median_error(line), unit), line->label));
  return "half of the poses err by less than " + listed(words, kMostLines);
}

}  // namespace mapproof
