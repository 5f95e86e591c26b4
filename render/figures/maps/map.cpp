#include "render/figures/maps/map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/geometry.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/score_text.hpp"
#include "render/figures/status_text.hpp"

namespace mapproof {
namespace {

constexpr double kReach = 0.75;  // Estimates this many room sides off are still shown in place.
constexpr std::size_t kMostWorst = 5;
constexpr const char* kTruePosition = "true position";  // Labels of the marks.
constexpr const char* kAnchor = "anchor";
constexpr Eigen::Index kMostDrawn = 5000;    // Landmarks; of more they would cover each other:
constexpr Eigen::Index kDrawnOfMore = 1000;  // so many are drawn.

void require_consistent(const MapRecord& record) {
  const auto rows = static_cast<Eigen::Index>(record.names.size());
  const auto refuse = [&record](const std::string& what) {
    throw InvalidInput("map " + printable(record.id) + ": " + what);
  };
  if (record.estimate.rows() != rows)
    refuse(fmt::format("{} estimates for {} names", record.estimate.rows(), rows));
  if (record.ground_truth_m && record.ground_truth_m->rows() != rows)
    refuse(fmt::format("{} true positions for {} names", record.ground_truth_m->rows(), rows));
  for (const Eigen::Index anchor : record.anchors)
    if (anchor < 0 || anchor >= rows) refuse(fmt::format("anchor {} is not a landmark", anchor));
  if (record.estimate.array().isInf().any() ||
      (record.ground_truth_m && record.ground_truth_m->array().isInf().any()))
    refuse("infinite coordinates");
}

/// Least and greatest of some rows.
class Extent {
 public:
  void see(double x, double y) {
    low_x_ = std::min(low_x_, x), high_x_ = std::max(high_x_, x);
    low_y_ = std::min(low_y_, y), high_y_ = std::max(high_y_, y);
  }
  double side() const { return std::max(high_x_ - low_x_, high_y_ - low_y_); }
  bool known() const { return low_x_ <= high_x_; }
  PanelBox grown(double by) const {
    return {{low_x_ - by, high_x_ + by}, {low_y_ - by, high_y_ + by}};
  }

 private:
  double low_x_ = kInfinity, high_x_ = -kInfinity, low_y_ = kInfinity, high_y_ = -kInfinity;
};

/// The middle 80 % of a column, NaN left out.
Range middle_of(const Points& points, Eigen::Index column) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (!points.row(i).hasNaN()) values.push_back(points(i, column));
  std::ranges::sort(values);
  const std::size_t cut = values.size() / 10;
  return {values[cut], values[values.size() - 1 - cut]};
}

/// Where a reader's eye belongs: the room if the ground truth is known, else the bulk of the
/// estimates.
Extent core_of(const MapRecord& record, const MapView& view) {
  Extent extent;
  if (record.frame == Frame::kGroundTruth) {
    for (Eigen::Index i = 0; i < record.estimate.rows(); ++i)
      if (view.has_ground_truth[i])
        extent.see((*record.ground_truth_m)(i, 0), (*record.ground_truth_m)(i, 1));
    if (extent.known()) return extent;
  }
  constexpr std::size_t kFewest = 8;  // Of fewer points none is called an outlier.
  if (view.has_estimate.size() - view.unmapped.size() < kFewest) return extent;
  const Range x = middle_of(record.estimate, 0), y = middle_of(record.estimate, 1);
  const double side = std::max(x.high - x.low, y.high - y.low);
  extent.see(x.low - side, y.low - side);
  extent.see(x.high + side, y.high + side);
  return extent;
}

void find_outside(const MapRecord& record, MapView& view) {
  const Extent core = core_of(record, view);
  if (!core.known() || core.side() <= 0.0) return;
  const PanelBox reach = core.grown(kReach * core.side());
  Extent shown;
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i)
    if (view.has_ground_truth[i])
      shown.see((*record.ground_truth_m)(i, 0), (*record.ground_truth_m)(i, 1));
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i) {
    if (!view.has_estimate[i]) continue;
    const double x = record.estimate(i, 0), y = record.estimate(i, 1);
    if (reach.holds(x, y))
      shown.see(x, y);
    else
      view.outside.push_back(i);
  }
  if (!view.outside.empty()) view.limits = shown.grown(0.08 * shown.side());
}

void find_outside(const MapRecord& record, const PanelBox& limits, MapView& view) {
  view.limits = limits;
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i)
    if (view.has_estimate[i] && !limits.holds(record.estimate(i, 0), record.estimate(i, 1)))
      view.outside.push_back(i);
}

void find_worst(MapView& view) {
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(view.error_m.size()); ++i)
    if (view.error_m[i] > 0.0 && !view.is_anchor[i]) view.worst.push_back(i);
  std::ranges::stable_sort(view.worst, std::ranges::greater{},
                           [&view](Eigen::Index i) { return view.error_m[i]; });
  const std::size_t most = view.error_m.size() < 15 ? 3 : kMostWorst;
  view.worst.resize(std::min(view.worst.size(), most));
}

constexpr std::size_t kMostNamed = 5;  // Names in one sentence.
constexpr Eigen::Index kMostLabelsOfShape =
    30;  // Without ground truth all names are shown up to this.

std::string subject(const MapRecord& record, std::string_view separator) {
  if (!std::holds_alternative<FromSensor>(record.origin))
    return method_label(record) + ", " + sensor_label(record);
  return fmt::format("{}{}{}{}{}", method_label(record), separator, sensor_label(record), separator,
                     counted(static_cast<std::size_t>(std::max(record.step, 0)), "step"));
}

std::string score_text(const MapRecord& record) {
  return record.score ? score_text(*record.score) : std::string();
}

std::string names_of(const MapRecord& record, const std::vector<Eigen::Index>& rows) {
  std::vector<std::string> names;
  for (const Eigen::Index row : rows) names.push_back(record.names[row]);
  return listed(names, kMostNamed);
}

class MapFigure {
 public:
  MapFigure(const MapRecord& record, const std::string& id, const std::string& what,
            const std::optional<PanelBox>& limits = std::nullopt)
      : record_(record),
        view_(view_of(record, limits)),
        what_(what),
        every_(record.estimate.rows() > kMostDrawn ? record.estimate.rows() / kDrawnOfMore : 1) {
    figure_.id = id;
    figure_.title = what.empty() ? subject(record, " · ") : what;
    figure_.record_ids = {record.id};
  }

  Figure make() {
    figure_.panels.push_back(panel());
    add_notes();
    add_words();
    return std::move(figure_);
  }

  Panel panel() const {
    Panel panel;
    panel.equal_aspect = true;
    const bool metres = record_.frame == Frame::kGroundTruth;
    panel.x.label = metres ? "x [m]" : "x (arbitrary unit)";
    panel.y.label = metres ? "y [m]" : "y (arbitrary unit)";
    if (view_.limits) {
      panel.x.limits = view_.limits->x;
      panel.y.limits = view_.limits->y;
    }
    panel.layers = {errors(),           arrows(),    ground_truth(false),
                    ground_truth(true), estimates(), labels()};
    std::erase_if(panel.layers, is_empty);
    return panel;
  }

 private:
  void add_notes() {
    std::vector<Note>& notes = figure_.notes;
    if (record_.names.empty()) notes.push_back({"There are no landmarks.", ThemeColour::kWarning});
    if (const std::string score = score_text(record_); !score.empty()) notes.push_back({score});
    if (record_.frame == Frame::kSimilarity)
      notes.push_back({"Shape alone: translation, rotation, scale and reflection are arbitrary."});
    if (every_ > 1) notes.push_back({drawn_text()});
    if (!view_.outside.empty()) notes.push_back({outside_text(), ThemeColour::kWarning});
    if (!view_.unmapped.empty())
      notes.push_back(
          {"Not on the map: " + names_of(record_, view_.unmapped) + ".", ThemeColour::kWarning});
    std::vector<std::string> statuses;
    for (const Status& status : record_.statuses) statuses.push_back(status_text(status));
    add_status_notes(statuses, notes);
  }

  std::string drawn_text() const {
    return fmt::format("Drawn: one in {} of {}, the anchors, and the largest errors.", every_,
                       counted(record_.names.size(), "landmark"));
  }

  std::string outside_text() const {
    std::string text =
        fmt::format("Arrows: {} outside the image", counted(view_.outside.size(), "estimate"));
    double farthest = 0.0;
    for (const Eigen::Index i : view_.outside)
      if (view_.error_m[i] > farthest) farthest = view_.error_m[i];
    return farthest > 0.0 ? text + ", up to " + error_text(farthest) + " off." : text + ".";
  }

  void add_words() {
    std::string& caption = figure_.caption;
    caption = what_.empty() ? subject(record_, ", ") : what_;
    const std::string score = score_text(record_);
    if (!score.empty()) caption += ": " + score;
    caption += ".";
    if (record_.frame == Frame::kSimilarity)
      caption += " Dots: estimates; translation, rotation, scale and reflection are arbitrary.";
    else if (record_.anchors.empty() && !record_.ground_truth_m)
      caption += " Dots: estimates; translation and rotation are arbitrary.";
    else
      caption += " " + marks_text(figure_.panels);
    if (every_ > 1) caption += " " + drawn_text();
    if (!view_.worst.empty())
      caption += fmt::format(" Worst{}: {}.", beside_anchors(), worst_text());
    if (!view_.outside.empty()) caption += " " + outside_text();
    if (!view_.unmapped.empty())
      caption += " Not on the map: " + names_of(record_, view_.unmapped) + ".";
    for (const Status& status : record_.statuses) caption += " " + status_text(status);

    const std::size_t mapped = record_.names.size() - view_.unmapped.size();
    figure_.alt =
        fmt::format("Map of {} of {} by {}, {}.", mapped, counted(record_.names.size(), "landmark"),
                    what_.empty() ? method_label(record_) : what_,
                    record_.frame == Frame::kGroundTruth ? "in metres" : "in an arbitrary frame");
    if (!score.empty()) figure_.alt += " " + score + ".";
    if (!view_.worst.empty())
      figure_.alt += fmt::format(" The largest errors{}: {}.", beside_anchors(), worst_text());
  }

  /// Anchors may have larger errors than the worst of the others.
  const char* beside_anchors() const { return record_.anchors.empty() ? "" : " but for anchors"; }

  std::string worst_text() const {
    std::vector<std::string> parts;
    for (const Eigen::Index i : view_.worst)
      parts.push_back(fmt::format("{} ({})", record_.names[i], error_text(view_.error_m[i])));
    return listed(parts, kMostNamed);
  }

  bool is_drawn(Eigen::Index row) const {
    return every_ == 1 || row % every_ == 0 || view_.is_anchor[row] ||
           std::ranges::find(view_.worst, row) != view_.worst.end();
  }

  bool is_outside(Eigen::Index row) const { return std::ranges::binary_search(view_.outside, row); }

  Mark mark(std::string_view kind, Eigen::Index row) const {
    Mark mark{fmt::format("{}-{}", kind, row + 1), {}};
    mark.data.emplace_back("landmark", record_.names[row]);
    mark.data.emplace_back("kind", kind);
    return mark;
  }

  Segments errors() const {
    Segments lines{.label = "error", .colour = ThemeColour::kMuted, .width = 0.8};
    for (Eigen::Index i = 0; i < rows(); ++i) {
      if (!is_drawn(i) || std::isnan(view_.error_m[i]) || is_outside(i)) continue;
      add_line(lines, true_position(i), position(i));
      lines.marks.push_back(mark("error", i));
      lines.marks.back().data.emplace_back("error", data_number(view_.error_m[i]));
    }
    return lines;
  }

  /// From the true position toward the estimate, up to the edge of the image.
  Segments arrows() const {
    Segments lines{
        .label = "estimate outside", .colour = ThemeColour::kSeries1, .width = 0.8, .arrow = true};
    for (const Eigen::Index i : view_.outside) {
      if (!is_drawn(i)) continue;
      const Box inner = image(0.012);
      const Point from = view_.has_ground_truth[i] ? true_position(i) : inner.centre();
      double enter = 0.0, leave = 0.0;
      if (!clip_line(inner, from, position(i), enter, leave)) continue;
      const auto along = [&](double share) {
        return Point{std::lerp(from.x, position(i).x, share),
                     std::lerp(from.y, position(i).y, share)};
      };
      add_line(lines, along(view_.has_ground_truth[i] ? 0.0 : 0.9 * leave), along(leave));
      lines.marks.push_back(mark("outside", i));
      add_position(lines.marks.back(), position(i));
      if (!std::isnan(view_.error_m[i]))
        lines.marks.back().data.emplace_back("error", data_number(view_.error_m[i]));
    }
    return lines;
  }

  Scatter ground_truth(bool anchors) const {
    Scatter points{.label = anchors ? kAnchor : kTruePosition,
                   .colour = anchors ? ThemeColour::kSeries2 : ThemeColour::kText,
                   .marker = anchors ? Marker::kSquare : Marker::kCircle,
                   .filled = false,
                   .size = anchors ? 1.5 : 1.0};
    for (Eigen::Index i = 0; i < rows(); ++i) {
      if (!is_drawn(i) || !view_.has_ground_truth[i] || view_.is_anchor[i] != anchors) continue;
      add_point(points, true_position(i));
      points.marks.push_back(mark(anchors ? "anchor" : "true", i));
      add_position(points.marks.back(), true_position(i));
    }
    return points;
  }

  Scatter estimates() const {
    // A single entry needs no legend, and would resemble one more landmark.
    const bool alone = record_.frame == Frame::kSimilarity && view_.outside.empty();
    Scatter points{.label = alone ? "" : "estimate", .colour = ThemeColour::kSeries1, .size = 0.8};
    for (Eigen::Index i = 0; i < rows(); ++i) {
      if (!is_drawn(i) || !view_.has_estimate[i] || is_outside(i)) continue;
      add_point(points, position(i));
      points.marks.push_back(mark("estimate", i));
      add_position(points.marks.back(), position(i));
      if (!std::isnan(view_.error_m[i]))
        points.marks.back().data.emplace_back("error", data_number(view_.error_m[i]));
    }
    return points;
  }

  PointLabels labels() const {
    PointLabels labels;
    std::vector<Eigen::Index> named = view_.worst;
    // Without errors no landmark is worse than the others.
    const bool names_all = record_.frame == Frame::kSimilarity || named.empty();
    if (names_all && rows() <= kMostLabelsOfShape)
      for (Eigen::Index i = 0; i < rows(); ++i)
        if (view_.has_estimate[i]) named.push_back(i);
    for (const Eigen::Index i : named) {
      // At the true position, which is the same on the maps of all methods.
      if (is_outside(i) && !view_.has_ground_truth[i]) continue;
      const Point at = view_.has_ground_truth[i] ? true_position(i) : position(i);
      add_label(labels, at, record_.names[i]);
    }
    return labels;
  }

  Eigen::Index rows() const { return record_.estimate.rows(); }
  Point position(Eigen::Index row) const {
    return {record_.estimate(row, 0), record_.estimate(row, 1)};
  }
  Point true_position(Eigen::Index row) const {
    return {(*record_.ground_truth_m)(row, 0), (*record_.ground_truth_m)(row, 1)};
  }

  Box image(double inset) const {
    const auto& [x, y] = *view_.limits;
    const double by = inset * std::max(x.high - x.low, y.high - y.low);
    return Box{x.low, y.low, x.high, y.high}.grown(-by);
  }

  static void add_position(Mark& mark, Point p) {
    mark.data.emplace_back("x", data_number(p.x));
    mark.data.emplace_back("y", data_number(p.y));
  }

  const MapRecord& record_;
  MapView view_;
  std::string what_;
  Eigen::Index every_;  ///< 1: all landmarks are drawn.
  Figure figure_;
};

}  // namespace

MapView view_of(const MapRecord& record, const std::optional<PanelBox>& limits) {
  require_consistent(record);
  const Eigen::Index rows = record.estimate.rows();
  MapView view;
  view.is_anchor.assign(rows, false);
  for (const Eigen::Index anchor : record.anchors) view.is_anchor[anchor] = true;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const bool mapped = !record.estimate.row(i).hasNaN();
    const bool true_known = record.ground_truth_m && !record.ground_truth_m->row(i).hasNaN();
    const bool comparable = mapped && true_known && record.frame == Frame::kGroundTruth;
    view.has_estimate.push_back(mapped);
    view.has_ground_truth.push_back(true_known && record.frame == Frame::kGroundTruth);
    view.error_m.push_back(
        comparable ? (record.estimate.row(i) - record.ground_truth_m->row(i)).norm() : kNaN);
    if (!mapped) view.unmapped.push_back(i);
  }
  find_worst(view);
  if (limits)
    find_outside(record, *limits, view);
  else
    find_outside(record, view);
  return view;
}

Figure map_figure(const MapRecord& record, const std::string& id, const std::string& what) {
  return MapFigure(record, id, what).make();
}

std::string marks_text(const std::vector<Panel>& panels) {
  bool has_circles = false, has_squares = false;
  for (const Panel& panel : panels)
    for (const Layer& layer : panel.layers)
      if (const auto* points = std::get_if<Scatter>(&layer)) {
        has_circles = has_circles || points->label == kTruePosition;
        has_squares = has_squares || points->label == kAnchor;
      }
  if (has_circles)
    return fmt::format("Open circles: true positions; dots: estimates, joined by their errors{}.",
                       has_squares ? "; squares: anchors" : "");
  return fmt::format(
      "Dots: estimates{}.",
      has_squares ? "; squares: given positions of anchors, joined to their estimates" : "");
}

Panel map_panel(const MapRecord& record, const std::string& prefix,
                const std::optional<PanelBox>& limits) {
  Panel panel = MapFigure(record, "panel", "", limits).panel();
  prefix_mark_ids(panel, prefix);
  return panel;
}

}  // namespace mapproof
