#include "render/figures/maps/map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/base/geometry.hpp"
#include "render/figures/maps/map_view.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/score_words.hpp"
#include "render/figures/status_words.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostNamed = 5;            // Names in one sentence.
constexpr Eigen::Index kMostLabelsOfShape = 30;  // Without a truth all names are shown up to this.

std::string subject(const MapRecord& record, std::string_view separator) {
  if (!std::holds_alternative<FromSensor>(record.origin))
    return method_label(record) + ", " + sensor_label(record);
  return fmt::format("{}{}{}{}{}", method_label(record), separator, sensor_label(record), separator,
                     counted(static_cast<std::size_t>(std::max(record.step, 0)), "step"));
}

std::string score_text(const MapRecord& record) {
  return record.score ? score_words(*record.score) : std::string();
}

std::string names_of(const MapRecord& record, const std::vector<Eigen::Index>& rows) {
  std::vector<std::string> names;
  for (const Eigen::Index row : rows) names.push_back(record.names[row]);
  return listed(names, kMostNamed);
}

class MapFigure {
 public:
  MapFigure(const MapRecord& record, const std::string& id, const std::string& what)
      : record_(record), view_(view_of(record)), what_(what) {
    figure_.id = id;
    figure_.title = what.empty() ? subject(record, " · ") : what;
    figure_.record_ids = {record.id};
  }

  Figure make() {
    add_notes();
    add_words();
    figure_.panels.push_back(panel());
    return std::move(figure_);
  }

  Panel panel() const {
    Panel panel;
    panel.equal_aspect = true;
    const bool metres = record_.frame == Frame::kTruth;
    panel.x.label = metres ? "x [m]" : "x (arbitrary unit)";
    panel.y.label = metres ? "y [m]" : "y (arbitrary unit)";
    if (view_.limits) {
      panel.x.limits = view_.limits->x;
      panel.y.limits = view_.limits->y;
    }
    panel.layers = {errors(), arrows(), truth(false), truth(true), estimates(), labels()};
    std::erase_if(panel.layers, is_empty);
    return panel;
  }

 private:
  void add_notes() {
    std::vector<Note>& notes = figure_.notes;
    if (record_.names.empty()) notes.push_back({"There are no landmarks.", Ink::kWarning});
    if (const std::string score = score_text(record_); !score.empty()) notes.push_back({score});
    if (record_.frame == Frame::kSimilarity)
      notes.push_back({"Shape alone: place, turn, scale and mirror are arbitrary."});
    if (!view_.outside.empty()) notes.push_back({outside_text(), Ink::kWarning});
    if (!view_.unmapped.empty())
      notes.push_back(
          {"Not on the map: " + names_of(record_, view_.unmapped) + ".", Ink::kWarning});
    std::vector<std::string> statuses;
    for (const Status& status : record_.statuses) statuses.push_back(status_words(status));
    add_status_notes(statuses, notes);
  }

  std::string outside_text() const {
    std::string text =
        fmt::format("Arrows: {} outside the picture", counted(view_.outside.size(), "estimate"));
    double farthest = 0.0;
    for (const Eigen::Index i : view_.outside)
      if (view_.error_m[i] > farthest) farthest = view_.error_m[i];
    return farthest > 0.0 ? text + ", up to " + significant(farthest) + " m off." : text + ".";
  }

  void add_words() {
    std::string& caption = figure_.caption;
    caption = what_.empty() ? subject(record_, ", ") : what_;
    const std::string score = score_text(record_);
    if (!score.empty()) caption += ": " + score;
    caption += ".";
    if (record_.frame == Frame::kSimilarity)
      caption += " Dots: estimates; place, turn, scale and mirror are arbitrary.";
    else if (record_.anchors.empty() && !record_.truth_m)
      caption += " Dots: estimates; place and turn are arbitrary.";
    else
      caption +=
          " Open circles: true positions; dots: estimates, joined by their errors; squares: "
          "anchors.";
    if (!view_.worst.empty()) caption += " Worst: " + worst_text() + ".";
    if (!view_.outside.empty()) caption += " " + outside_text();
    if (!view_.unmapped.empty())
      caption += " Not on the map: " + names_of(record_, view_.unmapped) + ".";
    for (const Status& status : record_.statuses) caption += " " + status_words(status);

    const std::size_t mapped = record_.names.size() - view_.unmapped.size();
    figure_.alt =
        fmt::format("Map of {} of {} by {}, {}.", mapped, counted(record_.names.size(), "landmark"),
                    what_.empty() ? method_label(record_) : what_,
                    record_.frame == Frame::kTruth ? "in metres" : "in an arbitrary frame");
    if (!score.empty()) figure_.alt += " " + score + ".";
    if (!view_.worst.empty()) figure_.alt += " The largest errors: " + worst_text() + ".";
  }

  std::string worst_text() const {
    std::vector<std::string> parts;
    for (const Eigen::Index i : view_.worst)
      parts.push_back(record_.names[i] + " " + significant(view_.error_m[i]) + " m");
    return listed(parts, kMostNamed);
  }

  bool is_outside(Eigen::Index row) const { return std::ranges::binary_search(view_.outside, row); }

  Mark mark(std::string_view kind, Eigen::Index row) const {
    Mark mark{fmt::format("{}-{}", kind, row + 1), {}};
    mark.data.emplace_back("landmark", record_.names[row]);
    mark.data.emplace_back("kind", kind);
    return mark;
  }

  Segments errors() const {
    Segments lines{.label = "error", .ink = Ink::kMuted, .width = 0.8};
    for (Eigen::Index i = 0; i < rows(); ++i) {
      if (std::isnan(view_.error_m[i]) || is_outside(i)) continue;
      add_line(lines, true_place(i), place(i));
      lines.marks.push_back(mark("error", i));
      lines.marks.back().data.emplace_back("error", data_number(view_.error_m[i]));
    }
    return lines;
  }

  /// From the true place toward the estimate, up to the edge of the picture.
  Segments arrows() const {
    Segments lines{.label = "estimate outside", .ink = Ink::kSeries1, .width = 0.8, .arrow = true};
    for (const Eigen::Index i : view_.outside) {
      const Box inner = picture(0.012);
      const Point from = view_.has_truth[i] ? true_place(i) : inner.centre();
      double enter = 0.0, leave = 0.0;
      if (!clip_line(inner, from, place(i), enter, leave)) continue;
      const auto along = [&](double share) {
        return Point{std::lerp(from.x, place(i).x, share), std::lerp(from.y, place(i).y, share)};
      };
      add_line(lines, along(view_.has_truth[i] ? 0.0 : 0.9 * leave), along(leave));
      lines.marks.push_back(mark("outside", i));
      add_place(lines.marks.back(), place(i));
      if (!std::isnan(view_.error_m[i]))
        lines.marks.back().data.emplace_back("error", data_number(view_.error_m[i]));
    }
    return lines;
  }

  Scatter truth(bool anchors) const {
    Scatter points{.label = anchors ? "anchor" : "true position",
                   .ink = anchors ? Ink::kSeries2 : Ink::kText,
                   .marker = anchors ? Marker::kSquare : Marker::kCircle,
                   .filled = false,
                   .size = anchors ? 1.5 : 1.0};
    for (Eigen::Index i = 0; i < rows(); ++i) {
      if (!view_.has_truth[i] || view_.is_anchor[i] != anchors) continue;
      add_point(points, true_place(i));
      points.marks.push_back(mark(anchors ? "anchor" : "true", i));
      add_place(points.marks.back(), true_place(i));
    }
    return points;
  }

  Scatter estimates() const {
    // A single entry would need no legend, and look like one more landmark.
    const bool alone = record_.frame == Frame::kSimilarity && view_.outside.empty();
    Scatter points{.label = alone ? "" : "estimate", .ink = Ink::kSeries1, .size = 0.8};
    for (Eigen::Index i = 0; i < rows(); ++i) {
      if (!view_.has_estimate[i] || is_outside(i)) continue;
      add_point(points, place(i));
      points.marks.push_back(mark("estimate", i));
      add_place(points.marks.back(), place(i));
      if (!std::isnan(view_.error_m[i]))
        points.marks.back().data.emplace_back("error", data_number(view_.error_m[i]));
    }
    return points;
  }

  PointLabels labels() const {
    PointLabels labels;
    std::vector<Eigen::Index> named = view_.worst;
    if (record_.frame == Frame::kSimilarity && rows() <= kMostLabelsOfShape)
      for (Eigen::Index i = 0; i < rows(); ++i)
        if (view_.has_estimate[i]) named.push_back(i);
    for (const Eigen::Index i : named) {
      // At the true place, which is the same on the maps of all methods.
      if (is_outside(i) && !view_.has_truth[i]) continue;
      const Point at = view_.has_truth[i] ? true_place(i) : place(i);
      add_label(labels, at, record_.names[i]);
    }
    return labels;
  }

  Eigen::Index rows() const { return record_.estimate.rows(); }
  Point place(Eigen::Index row) const {
    return {record_.estimate(row, 0), record_.estimate(row, 1)};
  }
  Point true_place(Eigen::Index row) const {
    return {(*record_.truth_m)(row, 0), (*record_.truth_m)(row, 1)};
  }

  Box picture(double inset) const {
    const auto& [x, y] = *view_.limits;
    const double by = inset * std::max(x.high - x.low, y.high - y.low);
    return Box{x.low, y.low, x.high, y.high}.grown(-by);
  }

  static void add_place(Mark& mark, Point p) {
    mark.data.emplace_back("x", data_number(p.x));
    mark.data.emplace_back("y", data_number(p.y));
  }

  const MapRecord& record_;
  MapView view_;
  std::string what_;
  Figure figure_;
};

}  // namespace

Figure map_figure(const MapRecord& record, const std::string& id, const std::string& what) {
  return MapFigure(record, id, what).make();
}

Panel map_panel(const MapRecord& record, const std::string& prefix) {
  Panel panel = MapFigure(record, "panel", "").panel();
  for (Layer& layer : panel.layers)
    std::visit(
        [&prefix](auto& one) {
          if constexpr (requires { one.marks; })
            for (Mark& mark : one.marks) mark.id = prefix + mark.id;
        },
        layer);
  return panel;
}

}  // namespace mapproof
