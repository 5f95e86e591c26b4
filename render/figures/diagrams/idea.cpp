#include "render/figures/diagrams/idea.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/score_words.hpp"

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
    refuse("a place is not finite");
  if (spec.history.values.array().isInf().any()) refuse("an infinite observation");
}

Panel room_of(const IdeaSpec& spec) {
  Panel panel;
  panel.title = "Room and walk";
  panel.bare = panel.equal_aspect = true;
  Area walls{.ink = Ink::kText, .fill = Fill::kNone, .outlined = true, .width = 1.3};
  add_box(walls, {0.0, spec.world.side_m}, {0.0, spec.world.side_m});
  Ellipses landmarks{.ink = Ink::kText, .fill = Fill::kSolid, .width = 0.6};
  for (Eigen::Index i = 0; i < spec.world.landmarks_m.rows(); ++i)
    add_disc(landmarks, point_of(spec.world.landmarks_m.row(i)),
             spec.world.landmark_diameter_m / 2.0);
  Polyline walk{.ink = Ink::kSeries1, .width = 0.7, .mark = {"walk", {}}};
  const Eigen::Index steps = std::min<Eigen::Index>(spec.steps, spec.path_m.rows());
  for (Eigen::Index i = 0; i < steps; ++i) add_point(walk, point_of(spec.path_m.row(i)));
  Scatter robot{.ink = Ink::kSeries2, .marker = Marker::kDiamond, .size = 1.4};
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
  cells.limits = limits_of(spec.history);
  cells.ramp = spec.history.sensor == Sensor::kVisibility ? Ramp::kInk : Ramp::kViridis;
  cells.mark = {"history", {{"sensor", std::string(name(spec.history.sensor))}}};
  Area border{.ink = Ink::kText, .fill = Fill::kNone, .outlined = true, .width = 0.8};
  add_box(border, {0.0, 1.0}, {0.0, 1.0});
  panel.layers = {cells, border};
  return panel;
}

Panel map_of(const IdeaSpec& spec) {
  Panel panel = map_panel(spec.map, "map-");
  panel.title = "Map";
  panel.bare = true;
  for (Layer& layer : panel.layers)
    std::visit(
        [](auto& one) {
          if constexpr (requires { one.label; }) one.label.clear();
        },
        layer);
  std::erase_if(panel.layers,
                [](const Layer& layer) { return std::holds_alternative<PointLabels>(layer); });
  return panel;
}

std::string colours(Sensor sensor) {
  if (sensor == Sensor::kVisibility) return "dark where it was seen";
  if (sensor == Sensor::kBearing) return "from −180° (dark) to 180° (light)";
  return "from near (dark) to far (light)";
}

}  // namespace

Figure idea_figure(const IdeaSpec& spec) {
  require_consistent(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = "From what was observed to a map, without any pose";
  figure.record_ids = {spec.map.id};
  figure.panels = {room_of(spec), history_of(spec), map_of(spec)};
  for (Panel& panel : figure.panels) std::erase_if(panel.layers, is_empty);
  figure.arrows = {{0, "observe"}, {1, "embed"}};
  const std::string score = spec.map.score ? score_words(*spec.map.score) : "";
  figure.caption = fmt::format(
      "The robot walks among landmarks (left); each landmark's row of observations, {} (middle); "
      "landmarks with like rows come to stand close together (right: {}, {}{}). Open circles: true "
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

}  // namespace mapproof
