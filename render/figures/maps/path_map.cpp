#include "render/figures/maps/path_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/figures/curves/thinning.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/maps/covariance_ellipse.hpp"
#include "render/figures/maps/ellipse_frame.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "render/figures/status_text.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr double kPathReach = 0.5;  // Sides about the core that paths may take up.
constexpr double kMargin = 0.05;    // Of the image's side.
constexpr double kVisible = 0.06;   // Half axis of the largest ellipse, of the side, at most.
constexpr double kRim = 0.1;        // Between an ellipse and the frame, of its half axes.
constexpr double kTolerance = 1.0 / 3600.0;  // Of the side.

void require_consistent(const PathMapSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  const auto landmarks = std::ssize(spec.run.log.landmarks);
  const auto& ground_truth = spec.run.log.true_landmarks;
  if (ground_truth && ground_truth->rows() != landmarks)
    refuse("not as many true landmarks as names");
  for (const Index known : spec.run.known)
    if (known < 0 || known >= landmarks) refuse(fmt::format("known {} is not a landmark", known));
  for (const SlamRecord& record : spec.run.records) {
    const SlamEstimate& estimate = record.estimate;
    const Index size = estimate.path.size();
    if (estimate.path.positions_m.rows() != size) refuse("times and positions differ in number");
    if (!record.error_m.empty() && std::ssize(record.error_m) != size)
      refuse("not as many errors as positions");
    if (estimate.landmarks_m.rows() != 0 && estimate.landmarks_m.rows() != landmarks)
      refuse("not as many landmarks as names");
    if (!estimate.landmark_cov_m2.empty() && std::ssize(estimate.landmark_cov_m2) != landmarks)
      refuse("not as many covariances as landmarks");
    if (estimate.position_cov_m2.size() != estimate.position_cov_rows.size())
      refuse("not as many covariances as their rows");
    for (const Index row : estimate.position_cov_rows)
      if (row < 0 || row >= size) refuse(fmt::format("covariance of no position, {}", row));
  }
}

struct PathExtent {
  Span x, y;

  void see(const Eigen::RowVector2d& point) {
    if (!point.allFinite()) return;
    x.see(point.x()), y.see(point.y());
  }
  void see(const Points& points) {
    for (Index i = 0; i < points.rows(); ++i) see(Eigen::RowVector2d(points.row(i)));
  }
  double side() const { return x.known() ? std::max(x.high - x.low, y.high - y.low) : 0.0; }
  bool holds(const Eigen::RowVector2d& point, double by) const {
    return x.low - by <= point.x() && point.x() <= x.high + by && y.low - by <= point.y() &&
           point.y() <= y.high + by;
  }
};

/// The middle 90 % of a column, as far as its numbers are finite.
Range middle_range(const Points& points, Index column) {
  std::vector<double> values;
  for (Index i = 0; i < points.rows(); ++i)
    if (points.row(i).allFinite()) values.push_back(points(i, column));
  if (values.empty()) return {kNaN, kNaN};
  std::ranges::sort(values);
  const std::size_t cut = values.size() / 20;
  return {values[cut], values[values.size() - 1 - cut]};
}

/// Where a reader's eye belongs.
PathExtent core_of(const SlamRun& run, const PathView& view) {
  PathExtent core;
  if (run.log.ground_truth) core.see(run.log.ground_truth->positions_m);
  if (run.log.true_landmarks) core.see(*run.log.true_landmarks);
  if (core.side() > 0.0) return core;
  for (const SlamRecord* record : view.shown)
    for (const Points* points :
         {&record->estimate.path.positions_m, &record->estimate.landmarks_m}) {
      const Range x = middle_range(*points, 0), y = middle_range(*points, 1);
      core.see(Eigen::RowVector2d(x.low, y.low));
      core.see(Eigen::RowVector2d(x.high, y.high));
    }
  return core;
}

void find_limits(const SlamRun& run, PathView& view) {
  const PathExtent core = core_of(run, view);
  if (!core.x.known()) {
    view.limits = {{0.0, 1.0}, {0.0, 1.0}};
    return;
  }
  const double reach = core.side() > 0.0 ? kPathReach * core.side() : 1.0;
  PathExtent all = core;
  for (const SlamRecord* record : view.shown) {
    bool leaves = false;
    for (const Points* points : {&record->estimate.path.positions_m, &record->estimate.landmarks_m})
      for (Index i = 0; i < points->rows(); ++i) {
        if (core.holds(points->row(i), reach))
          all.see(Eigen::RowVector2d(points->row(i)));
        else
          leaves |= points->row(i).allFinite();
      }
    if (leaves) view.leaving.emplace_back(info(record->method).label);
  }
  view.side_m = all.side() > 0.0 ? all.side() : 1.0;
  const double by = kMargin * view.side_m;
  view.limits = {{all.x.low - by, all.x.high + by}, {all.y.low - by, all.y.high + by}};
}

/// The greatest round factor at which no ellipse is larger than the eye needs.
double enlargement(const PathView& view) {
  constexpr std::array kFactors = {100.0, 50.0, 20.0, 10.0, 5.0, 2.0};
  double longest_m = 0.0;
  for (const SlamRecord* record : view.shown)
    for (const Eigen::Matrix2d& C : record->estimate.landmark_cov_m2)
      if (C.allFinite()) longest_m = std::max(longest_m, covariance_ellipse(C).a);
  for (const double factor : kFactors)
    if (factor * longest_m <= kVisible * view.side_m) return factor;
  return 1.0;
}

/// Of landmarks within the limits, as far as with_ellipses() widens these.
void make_room_for_ellipses(PathView& view) {
  Ellipses rims;
  for (const SlamRecord* record : view.shown) {
    const auto& covariances = record->estimate.landmark_cov_m2;
    for (Index i = 0; i < std::ssize(covariances); ++i) {
      const Eigen::RowVector2d at = record->estimate.landmarks_m.row(i);
      if (!covariances[i].allFinite() || !view.shows(at)) continue;
      const Ellipse ellipse = covariance_ellipse(covariances[i]);
      const double drawn = (1.0 + kRim) * view.enlarged;
      rims.x.push_back(at.x()), rims.y.push_back(at.y());
      rims.a.push_back(drawn * ellipse.a), rims.b.push_back(drawn * ellipse.b);
      rims.rotation_rad.push_back(ellipse.rotation_rad);
    }
  }
  view.limits = with_ellipses(view.limits, rims);
}

bool any_finite(const Points& points) { return points.array().isFinite().any(); }

constexpr std::size_t kMostNamedLandmarks = 12;  // Landmarks with a name next to them.

std::string label_of(const SlamRecord& record) { return std::string(info(record.method).label); }

class PathMap {
 public:
  explicit PathMap(const PathMapSpec& spec) : spec_(spec), view_(path_view(spec)) {}

  Figure make() const {
    Figure figure;
    figure.id = spec_.id;
    figure.title = spec_.title;
    figure.record_ids = {spec_.run.id};
    figure.columns = 1;
    figure.panels.push_back(map_panel());
    if (auto errors = path_error_panel(view_.shown)) figure.panels.push_back(*std::move(errors));
    figure.notes = notes();
    figure.caption = caption(figure.panels.size() > 1);
    figure.alt = alt();
    require_valid(figure);
    return figure;
  }

 private:
  Panel map_panel() const {
    Panel panel;
    panel.equal_aspect = true;
    panel.x = {.label = "x [m]", .limits = view_.limits.x};
    panel.y = {.label = "y [m]", .limits = view_.limits.y};
    if (spec_.run.log.ground_truth)
      panel.layers.push_back(path(*spec_.run.log.ground_truth, "true path", "ground-truth",
                                  {.colour = kTrueColour, .width = kTrueWidth}));
    for (const SlamRecord* record : view_.shown) {
      panel.layers.push_back(
          path(record->estimate.path, label_of(*record), key(*record), path_style(record->method)));
    }
    panel.layers.push_back(true_landmarks(false));
    panel.layers.push_back(true_landmarks(true));
    for (const SlamRecord* record : view_.shown) {
      panel.layers.push_back(ellipses(*record));
      panel.layers.push_back(landmarks(*record));
    }
    panel.layers.push_back(names());
    std::erase_if(panel.layers, is_empty);
    if (any_ellipse()) panel.layers.emplace_back(ellipses_in_legend());
    return panel;
  }

  static std::string key(const SlamRecord& record) { return std::string(info(record.method).name); }

  Polyline path(const Trajectory& path, const std::string& label, const std::string& key,
                const PathStyle& style) const {
    ThinLine thin = thin_path(path, view_.tolerance_m);
    const Marker marker = thin.x.size() == 1 ? Marker::kCircle : Marker::kNone;
    return {.label = label,
            .x = std::move(thin.x),
            .y = std::move(thin.y),
            // Faint a marker would not be seen.
            .colour = marker != Marker::kNone && style.colour == ThemeColour::kFaint
                          ? ThemeColour::kMuted
                          : style.colour,
            .dash = style.dash,
            .width = style.width,
            .marker = marker,
            .mark = {"path-" + key, {{"curve", label}}}};
  }

  bool in_image(const Eigen::RowVector2d& at) const { return view_.shows(at); }

  bool is_known(Index row) const {
    return std::ranges::find(spec_.run.known, row) != spec_.run.known.end();
  }

  /// Whether a method that is shown was given the known landmarks.
  bool uses_known() const {
    return std::ranges::any_of(
        view_.shown, [](const SlamRecord* record) { return info(record->method).knows_landmarks; });
  }

  /// @param curve  The entry of the legend that it belongs to.
  Mark mark(const std::string& kind, const std::string& curve, Index row,
            const Eigen::RowVector2d& at) const {
    return {fmt::format("{}-{}", kind, row + 1),
            {{"landmark", spec_.run.log.landmarks[row]},
             {"curve", curve},
             {"kind", kind},
             {"x", data_number(at.x())},
             {"y", data_number(at.y())}}};
  }

  Scatter true_landmarks(bool known) const {
    Scatter points{.label = known ? "landmark, known" : "landmark, true",
                   .colour = ThemeColour::kText,
                   .marker = known ? Marker::kSquare : Marker::kCircle,
                   .filled = false,
                   .size = 1.5};
    if (!spec_.run.log.true_landmarks) return points;
    const Points& positions = *spec_.run.log.true_landmarks;
    for (Index i = 0; i < positions.rows(); ++i) {
      if ((is_known(i) && uses_known()) != known || !in_image(positions.row(i))) continue;
      add_point(points, point_of(positions.row(i)));
      points.marks.push_back(mark(known ? "known" : "true", points.label, i, positions.row(i)));
    }
    return points;
  }

  Scatter landmarks(const SlamRecord& record) const {
    const PathStyle style = path_style(record.method);
    Scatter points{
        .label = label_of(record), .colour = style.colour, .marker = style.marker, .size = 1.2};
    const Points& positions = record.estimate.landmarks_m;
    for (Index i = 0; i < positions.rows(); ++i) {
      if (!in_image(positions.row(i))) continue;
      add_point(points, point_of(positions.row(i)));
      points.marks.push_back(mark(key(record), points.label, i, positions.row(i)));
    }
    return points;
  }

  Ellipses ellipses(const SlamRecord& record) const {
    const PathStyle style = path_style(record.method);
    Ellipses ellipses{.label = label_of(record), .colour = style.colour, .width = 0.8};
    const auto& covariances = record.estimate.landmark_cov_m2;
    for (Index i = 0; i < std::ssize(covariances); ++i) {
      const Eigen::RowVector2d at = record.estimate.landmarks_m.row(i);
      if (!in_image(at) || !covariances[i].allFinite()) continue;
      const Ellipse ellipse = covariance_ellipse(covariances[i]);
      ellipses.x.push_back(at.x()), ellipses.y.push_back(at.y());
      ellipses.a.push_back(view_.enlarged * ellipse.a);
      ellipses.b.push_back(view_.enlarged * ellipse.b);
      ellipses.rotation_rad.push_back(ellipse.rotation_rad);
      ellipses.marks.push_back({fmt::format("ellipse-{}-{}", key(record), i + 1),
                                {{"landmark", spec_.run.log.landmarks[i]},
                                 {"curve", ellipses.label},
                                 {"a", data_number(ellipse.a)},
                                 {"b", data_number(ellipse.b)}}});
    }
    return ellipses;
  }

  PointLabels names() const {
    PointLabels labels;
    const auto& all = spec_.run.log.landmarks;
    if (all.size() > kMostNamedLandmarks) return labels;
    for (Index i = 0; i < std::ssize(all); ++i)
      if (const auto at = place_of(i)) add_label(labels, *at, all[i]);
    return labels;
  }

  /// Where a landmark is, or else where the first method has it.
  std::optional<Point> place_of(Index row) const {
    const auto& ground_truth = spec_.run.log.true_landmarks;
    if (ground_truth && in_image(ground_truth->row(row))) return point_of(ground_truth->row(row));
    for (const SlamRecord* record : view_.shown) {
      const Points& positions = record->estimate.landmarks_m;
      if (positions.rows() > 0 && in_image(positions.row(row))) return point_of(positions.row(row));
    }
    return std::nullopt;
  }

  bool any_ellipse() const {
    return std::ranges::any_of(
        view_.shown, [this](const SlamRecord* record) { return !ellipses(*record).x.empty(); });
  }

  /// An entry of the legend, which stands wherever a part of the figure is shown, for the ellipses
  /// of all methods.
  Ellipses ellipses_in_legend() const {
    std::string label = "95 % ellipse";
    if (view_.enlarged != 1.0) label += fmt::format(", {:g} \u00D7 as large", view_.enlarged);
    return {.label = label, .colour = ThemeColour::kMuted, .width = 0.8};
  }

  std::string ellipse_words() const {
    if (view_.enlarged == 1.0) return "ellipses: 95 % of each landmark";
    return fmt::format("ellipses: 95 % of each landmark, enlarged {:g} times", view_.enlarged);
  }

  std::vector<Note> notes() const {
    std::vector<Note> notes;
    if (view_.shown.empty()) notes.push_back({"No method gave a path.", ThemeColour::kWarning});
    if (!view_.leaving.empty())
      notes.push_back(
          {"Outside the image: " + listed(view_.leaving, 4) + ".", ThemeColour::kWarning});
    for (const SlamRecord* record : view_.shown)
      if (const auto note =
              cut_ellipses_note(ellipses(*record), view_.limits, " m", view_.enlarged))
        notes.push_back({fmt::format("{}: {}", label_of(*record), note->text), note->colour});
    std::vector<std::string> others;
    for (const SlamRecord* record : view_.failed) {
      const auto& statuses = record->estimate.statuses;
      others.push_back(fmt::format("{}: {}", label_of(*record),
                                   statuses.empty() ? "no path." : status_text(statuses.front())));
    }
    for (const SlamRecord* record : view_.shown)
      for (const Status& status : record->estimate.statuses)
        others.push_back(fmt::format("{}: {}", label_of(*record), status_text(status)));
    add_status_notes(others, notes);
    return notes;
  }

  std::string caption(bool with_errors) const {
    std::string text = fmt::format("{}: ", spec_.run.log.name);
    std::vector<std::string> parts;
    if (spec_.run.log.ground_truth) parts.emplace_back("the true path (the wide band)");
    for (const SlamRecord* record : view_.shown) parts.push_back(label_of(*record));
    text += listed(parts, 12) + ".";
    if (spec_.run.log.true_landmarks) text += " Open marks: true landmarks; crosses: recovered.";
    if (any_ellipse()) text += fmt::format(" {}.", capitalised(ellipse_words()));
    if (with_errors)
      text +=
          " Below: distance to the true position over time, the median of short pieces of time; "
          "its "
          "mean and alignment in the legend.";
    text += fmt::format(" Paths are thinned for drawing, by {} m at most.",
                        significant(view_.tolerance_m, 1));
    return text;
  }

  std::string alt() const {
    std::string text =
        fmt::format("Map of {} and {} of {}.", counted(std::ssize(view_.shown), "path"),
                    counted(std::ssize(spec_.run.log.landmarks), "landmark"), spec_.run.log.name);
    for (const SlamRecord* record : view_.shown) {
      if (record->errors.empty()) continue;
      const TrajectoryError& error = record->errors.front();
      text += fmt::format(" {}: mean error {} m ({}).", label_of(*record),
                          significant(error.mean_m), alignment_words(error.alignment));
    }
    return text;
  }

  const PathMapSpec& spec_;
  PathView view_;
};

}  // namespace

Figure path_map_figure(const PathMapSpec& spec) { return PathMap(spec).make(); }

bool PathView::shows(const Eigen::RowVector2d& at) const {
  const auto& [x, y] = limits;
  return x.low <= at.x() && at.x() <= x.high && y.low <= at.y() && at.y() <= y.high;  // Not NaN.
}

PathView path_view(const PathMapSpec& spec) {
  require_consistent(spec);
  PathView view;
  for (const SlamMethod method : spec.methods)
    for (const SlamRecord& record : spec.run.records) {
      if (record.method != method) continue;
      const bool came_out =
          any_finite(record.estimate.path.positions_m) || any_finite(record.estimate.landmarks_m);
      (came_out ? view.shown : view.failed).push_back(&record);
    }
  find_limits(spec.run, view);
  view.tolerance_m = kTolerance * view.side_m;
  view.enlarged = enlargement(view);
  make_room_for_ellipses(view);
  return view;
}

}  // namespace mapproof
