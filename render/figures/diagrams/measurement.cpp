#include "render/figures/diagrams/measurement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/diagrams/measurement_geometry.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/score_text.hpp"

namespace mapproof {
namespace {

constexpr int kMostSteps = 2000;

void require_consistent(const IdeaSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  const Eigen::Index M = spec.world.landmarks_m.rows();
  if (spec.steps < 1 || spec.steps > kMostSteps) refuse("steps are not in 1 to 2000");
  if (spec.history.values.rows() != M) refuse("the history has not as many landmarks as the world");
  if (static_cast<Eigen::Index>(spec.map.names.size()) != M)
    refuse("the map has not as many landmarks as the world");
  if (!(spec.world.side_m > 0.0) || !std::isfinite(spec.world.side_m) ||
      !(spec.world.landmark_diameter_m > 0.0) || !std::isfinite(spec.world.landmark_diameter_m))
    refuse("the room's side or the landmarks' diameter is not positive");
  if (!spec.world.landmarks_m.allFinite() || !spec.path_m.allFinite())
    refuse("a position is not finite");
  if (spec.history.values.array().isInf().any()) refuse("an infinite observation");
}

Panel room_of(const IdeaSpec& spec) {
  Panel panel;
  panel.title = "Room and walk";
  panel.bare = panel.equal_aspect = true;
  Area walls{.colour = ThemeColour::kText, .fill = Fill::kNone, .outlined = true, .width = 1.3};
  add_box(walls, {0.0, spec.world.side_m}, {0.0, spec.world.side_m});
  Ellipses landmarks{.colour = ThemeColour::kText, .fill = Fill::kSolid, .width = 0.6};
  for (Eigen::Index i = 0; i < spec.world.landmarks_m.rows(); ++i)
    add_disc(landmarks, point_of(spec.world.landmarks_m.row(i)),
             spec.world.landmark_diameter_m / 2.0);
  Polyline walk{.colour = ThemeColour::kSeries1, .width = 0.7, .mark = {"walk", {}}};
  const Eigen::Index steps = std::min<Eigen::Index>(spec.steps, spec.path_m.rows());
  for (Eigen::Index i = 0; i < steps; ++i) add_point(walk, point_of(spec.path_m.row(i)));
  Scatter robot{.colour = ThemeColour::kSeries2, .marker = Marker::kDiamond, .size = 1.4};
  if (steps > 0) add_point(robot, point_of(spec.path_m.row(steps - 1)));
  panel.layers = {walls, walk, landmarks, robot};
  return panel;
}

/// What the ramp runs over: 0 to 1, all directions, or what was measured.
Range limits_of(const ObservationHistory& history) {
  if (history.sensor == Sensor::kVisibility) return {0.0, 1.0};
  if (history.sensor == Sensor::kBearing) return {-std::numbers::pi, std::numbers::pi};
  Span span;
  for (Eigen::Index i = 0; i < history.values.size(); ++i) span.see(history.values.data()[i]);
  if (!span.known() || span.low == span.high) return {0.0, 1.0};
  return {span.low, span.high};
}

Panel history_of(const IdeaSpec& spec) {
  const Eigen::Index rows = spec.history.landmarks();
  const Eigen::Index columns = std::min<Eigen::Index>(spec.steps, spec.history.steps());
  Panel panel;
  panel.title = fmt::format("{}, {}", counted(rows, "landmark"), counted(columns, "step"));
  panel.bare = true;
  // As wide as the other panels are, whatever it holds.
  panel.equal_aspect = true;
  Cells cells{.x = {0.0, 1.0}, .y = {0.0, 1.0}, .columns = static_cast<std::size_t>(columns)};
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index t = 0; t < columns; ++t) cells.values.push_back(spec.history.values(i, t));
  cells.colour_scale.limits = limits_of(spec.history);
  cells.colour_scale.ramp =
      spec.history.sensor == Sensor::kVisibility ? Ramp::kColour : Ramp::kViridis;
  cells.mark = {"history", {{"sensor", std::string(name(spec.history.sensor))}}};
  Area border{.colour = ThemeColour::kText, .fill = Fill::kNone, .outlined = true, .width = 0.8};
  add_box(border, {0.0, 1.0}, {0.0, 1.0});
  panel.layers = {cells, border};
  return panel;
}

Panel map_of(const IdeaSpec& spec) {
  Panel panel = map_panel(spec.map, "map-");
  panel.title = "Map";
  panel.bare = true;
  for (Layer& layer : panel.layers) set_label(layer, "");
  std::erase_if(panel.layers,
                [](const Layer& layer) { return std::holds_alternative<PointLabels>(layer); });
  return panel;
}

std::string colours(Sensor sensor) {
  if (sensor == Sensor::kVisibility) return "dark where it was seen";
  if (sensor == Sensor::kBearing) return "from −180° (dark) to 180° (light)";
  return "from near (dark) to far (light)";
}

constexpr double kViewOfReach = 1.3;  // Half the side of the image of a disc.
constexpr Eigen::Index kTrail = 40;   // Steps of the path that are drawn.

class MeasurementFigure {
 public:
  MeasurementFigure(const Measurement& m, const std::string& id)
      : m_(m), robot_(point_of(m.robot_m)), radius_(m.world.landmark_diameter_m / 2.0) {
    figure_.id = id;
    panel_.equal_aspect = true;
    panel_.x.label = "x [m]";
    panel_.y.label = "y [m]";
  }

  Figure make() {
    m_.sensor == Sensor::kVisibility ? show_visibility() : show_bearings();
    std::erase_if(panel_.layers, is_empty);
    figure_.panels.push_back(std::move(panel_));
    return std::move(figure_);
  }

 private:
  void show_visibility() {
    const double half = kViewOfReach * m_.reach_m;
    panel_.x.limits = Range{robot_.x - half, robot_.x + half};
    panel_.y.limits = Range{robot_.y - half, robot_.y + half};
    Ellipses reach{.label = fmt::format("reach, {} mm", std::lround(1000.0 * m_.reach_m)),
                   .colour = ThemeColour::kText,
                   .dash = Dash::kDashed,
                   .width = 0.8};
    add_disc(reach, robot_, m_.reach_m);
    panel_.layers = {walls(),
                     shadows(),
                     reach,
                     trail(),
                     landmarks(View::kOutOfReach),
                     landmarks(View::kHidden),
                     landmarks(View::kVisible),
                     heading(0.22 * m_.reach_m),
                     robot()};
    const std::size_t seen = count(View::kVisible), hidden = count(View::kHidden);
    figure_.title = fmt::format("Visibility-only measurement: {} seen, {} hidden",
                                counted(seen, "landmark"), hidden);
    figure_.caption = fmt::format(
        "Visibility at step {} of layout {}, pose {}: of {} the robot sees {}; {} within {} mm "
        "hidden behind another. Filled: visible; heavy rings: hidden; pale: out of reach; grey: "
        "shadows.",
        m_.step, m_.run.layout, m_.run.pose, counted(m_.views.size(), "landmark"), seen,
        hidden == 1 ? "1 is" : fmt::format("{} are", hidden), std::lround(1000.0 * m_.reach_m));
    figure_.alt = fmt::format(
        "Plan of the room around the robot at ({}, {}) m. Within {} m {} visible and {} hidden; {} "
        "out of reach.",
        significant(robot_.x), significant(robot_.y), significant(m_.reach_m),
        counted(seen, "landmark"), hidden, count(View::kOutOfReach));
  }

  void show_bearings() {
    const double margin = 0.04 * m_.world.side_m;
    panel_.x.limits = panel_.y.limits = Range{-margin, m_.world.side_m + margin};
    const std::vector<Eigen::Index> named = named_bearings(m_);
    panel_.layers = {walls(), trail(), rays(named), landmarks(std::nullopt)};
    PointLabels labels;
    std::vector<std::string> words;
    for (std::size_t i = 0; i < named.size(); ++i) {
      add_angle(named[i], i);
      words.push_back(fmt::format("L{}: {}", named[i] + 1, degrees(m_.bearings_rad(named[i]))));
      add_label(labels, position(named[i]), words.back());
    }
    panel_.layers.push_back(heading(0.16 * m_.world.side_m));
    panel_.layers.push_back(robot());
    panel_.layers.push_back(labels);
    const auto known = static_cast<std::size_t>((m_.bearings_rad.array().isFinite()).count());
    figure_.title = "Bearing-only measurement: " + bearings_text(m_);
    figure_.caption = fmt::format(
        "Bearings at step {} of layout {}, pose {}: the angle from the heading (arrow) to each of "
        "{}.",
        m_.step, m_.run.layout, m_.run.pose, counted(known, "landmark"));
    figure_.alt =
        fmt::format("Plan of the room with the robot at ({}, {}) m and a ray to each of {}.",
                    significant(robot_.x), significant(robot_.y), counted(known, "landmark"));
    if (words.empty()) return;
    figure_.caption += " Named: " + listed(words, 3) + ".";
    figure_.alt += " Angles to the heading: " + listed(words, 3) + ".";
  }

  Area walls() const {
    Area room{.label = "",
              .colour = ThemeColour::kText,
              .fill = Fill::kNone,
              .outlined = true,
              .width = 1.6};
    add_box(room, {0.0, m_.world.side_m}, {0.0, m_.world.side_m});
    return room;
  }

  Area shadows() const {
    Area area{.label = "shadow", .colour = ThemeColour::kText, .fill = Fill::kTint};
    for (const std::vector<Point>& shadow : shadow_outlines(m_)) {
      for (const Point corner : shadow) add_corner(area, corner);
      end_outline(area);
    }
    return area;
  }

  /// Those of one view; all of them without one.
  Ellipses landmarks(std::optional<View> view) const {
    Ellipses discs{
        .label = "landmark", .colour = ThemeColour::kText, .fill = Fill::kPaper, .width = 0.8};
    if (view == View::kVisible) discs.label = "visible", discs.fill = Fill::kSolid;
    if (view == View::kVisible) discs.colour = ThemeColour::kSeries1;
    if (view == View::kHidden)
      discs.label = "hidden", discs.width = 1.3, discs.colour = ThemeColour::kSeries2;
    if (view == View::kOutOfReach) discs.label = "out of reach", discs.fill = Fill::kTint;
    if (view == View::kOutOfReach) discs.colour = ThemeColour::kMuted, discs.width = 0.6;
    for (Eigen::Index i = 0; i < rows(); ++i) {
      if (view && m_.views[i] != *view) continue;
      if (!is_shown(position(i))) continue;
      add_disc(discs, position(i), radius_);
      Mark mark{fmt::format("landmark-{}", i + 1), {{"landmark", fmt::format("L{}", i + 1)}}};
      if (view) mark.data.emplace_back("view", discs.label);
      if (!view) mark.data.emplace_back("bearing-rad", data_number(m_.bearings_rad(i)));
      discs.marks.push_back(std::move(mark));
    }
    return discs;
  }

  bool is_shown(Point p) const {
    const Range &x = *panel_.x.limits, &y = *panel_.y.limits;
    return x.low - radius_ < p.x && p.x < x.high + radius_ && y.low - radius_ < p.y &&
           p.y < y.high + radius_;
  }

  Segments rays(const std::vector<Eigen::Index>& named) const {
    Segments lines{.label = "ray", .colour = ThemeColour::kMuted, .width = 0.4};
    for (Eigen::Index i = 0; i < rows(); ++i)
      if (std::isfinite(m_.bearings_rad(i)) && std::ranges::find(named, i) == named.end())
        add_line(lines, robot_, position(i));
    return lines;
  }

  /// The ray to a landmark and the arc from the heading to it, the n-th farther out.
  void add_angle(Eigen::Index row, std::size_t n) {
    const ThemeColour colour = series_colour(n);
    const Dash dash = std::array{Dash::kSolid, Dash::kDashed, Dash::kDashDot}[n % 3];
    Polyline ray{.colour = colour, .dash = dash};
    add_point(ray, robot_);
    add_point(ray, position(row));
    Polyline arc{.colour = colour, .dash = dash};
    const double radius = (0.05 + 0.03 * static_cast<double>(n)) * m_.world.side_m;
    for (const Point p :
         arc_points(robot_, radius, m_.heading_rad, m_.heading_rad + m_.bearings_rad(row)))
      add_point(arc, p);
    panel_.layers.push_back(ray);
    panel_.layers.push_back(arc);
  }

  Polyline trail() const {
    Polyline line{
        .label = "path so far", .colour = ThemeColour::kMuted, .dash = Dash::kDotted, .width = 0.7};
    const Eigen::Index first = std::max<Eigen::Index>(0, m_.path_m.rows() - kTrail);
    for (Eigen::Index i = first; i < m_.path_m.rows(); ++i)
      add_point(line, point_of(m_.path_m.row(i)));
    return line;
  }

  Segments heading(double length) const {
    Segments arrow{.label = "heading", .colour = ThemeColour::kText, .arrow = true};
    add_line(arrow, robot_, beside(robot_, length, m_.heading_rad));
    return arrow;
  }

  Scatter robot() const {
    Scatter at{
        .label = "robot", .colour = ThemeColour::kText, .marker = Marker::kDiamond, .size = 1.4};
    add_point(at, robot_);
    at.marks.push_back({"robot", {{"kind", "robot"}}});
    return at;
  }

  std::size_t count(View view) const {
    return static_cast<std::size_t>(std::ranges::count(m_.views, view));
  }
  Eigen::Index rows() const { return m_.world.landmarks_m.rows(); }
  Point position(Eigen::Index row) const { return point_of(m_.world.landmarks_m.row(row)); }

  const Measurement& m_;
  Point robot_;
  double radius_;
  Panel panel_;
  Figure figure_;
};

}  // namespace

Figure idea_figure(const IdeaSpec& spec) {
  require_consistent(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = "From what was observed to a map, without any pose";
  if (spec.map.score && std::isfinite(spec.map.score->mpe_m))
    figure.title += fmt::format(": {} off", error_text(spec.map.score->mpe_m));
  figure.record_ids = {spec.map.id};
  figure.panels = {room_of(spec), history_of(spec), map_of(spec)};
  for (Panel& panel : figure.panels) std::erase_if(panel.layers, is_empty);
  figure.arrows = {{0, "observe"}, {1, "embed"}};
  const std::string score = spec.map.score ? score_text(*spec.map.score) : "";
  figure.caption = fmt::format(
      "The robot walks among landmarks (left); each landmark's row of observations, {} (middle); "
      "landmarks with similar rows are close together on the map (right: {}, {}{}). Open circles: "
      "true "
      "positions; dots: estimates; squares: anchors.",
      colours(spec.history.sensor), method_label(spec.map), counted(spec.map.step, "step"),
      score.empty() ? "" : ", " + score);
  figure.alt = fmt::format(
      "Three panels: a room with {} and a robot's path, their {} observations over {}, and the map "
      "by {}{}.",
      counted(spec.world.landmarks_m.rows(), "landmark"), name(spec.history.sensor),
      counted(std::min<Eigen::Index>(spec.steps, spec.history.steps()), "step"),
      method_label(spec.map), score.empty() ? "" : ", " + score);
  require_valid(figure);
  return figure;
}

Figure measurement_figure(const Measurement& measurement, const std::string& id) {
  require_consistent(measurement);
  Figure figure = MeasurementFigure(measurement, id).make();
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
