#include "render/scene/map_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/error_ramp.hpp"
#include "render/figures/maps/map.hpp"
#include "render/scene/displacements.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostWorst = 3;
constexpr double kGroundMargin = 0.06;  // Around what a map covers, of its side.
constexpr double kOpenRadius = 0.011;   // Of a landmark of no known size, of the ground's side.

void require_usable(const MapSceneSpec& spec) {
  const auto rows = static_cast<Eigen::Index>(spec.map.names.size());
  if (spec.map.estimate.rows() != rows || (spec.world && spec.world->landmarks_m.rows() != rows))
    throw InvalidInput("map_scene: the map is not of the world's landmarks");
  if (spec.world && !has_room(*spec.world))
    throw InvalidInput("map_scene: the room's side or the landmarks' diameter is not a length");
  if (!spec.world && !has_map_scene(spec.map))
    throw InvalidInput(
        "map_scene: fewer than three landmarks are mapped, or they do not span a "
        "length that can be drawn");
  if (!spec.half_axes.empty() && std::ssize(spec.half_axes) != rows)
    throw InvalidInput("map_scene: there is not one half axis a landmark");
  for (const Eigen::Index row : spec.map.anchors)
    if (row < 0 || row >= rows) throw InvalidInput("map_scene: an anchor is not a landmark");
}

/// The true positions that a map can be compared with; NaN rows where there are none.
Points ground_truth_of(const MapRecord& map) {
  if (map.ground_truth_m && map.frame == Frame::kGroundTruth) return *map.ground_truth_m;
  return Points::Constant(map.estimate.rows(), 2, kNaN);
}

/// Where the landmarks stand: at their true positions, the others where they are estimated, unless
/// that is too far from all others to be shown.
Points positions_of(const MapRecord& map, const Points& ground_truth_m) {
  Points at = ground_truth_m;
  const MapView view = view_of(map);
  for (Eigen::Index i = 0; i < at.rows(); ++i)
    if (!at.row(i).allFinite() && !std::ranges::binary_search(view.outside, i))
      at.row(i) = map.estimate.row(i);
  return at;
}

/// The ground that the positions cover; all NaN without any.
Ground ground_of(const Points& at) {
  Ground ground{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (Eigen::Index i = 0; i < at.rows(); ++i) {
    if (!at.row(i).allFinite()) continue;
    ground.low = {std::min(ground.low.x, at(i, 0)), std::min(ground.low.y, at(i, 1))};
    ground.high = {std::max(ground.high.x, at(i, 0)), std::max(ground.high.y, at(i, 1))};
  }
  const double margin = kGroundMargin * ground.side();
  ground.low = {ground.low.x - margin, ground.low.y - margin};
  ground.high = {ground.high.x + margin, ground.high.y + margin};
  return ground;
}

class MapScene {
 public:
  explicit MapScene(const MapSceneSpec& spec)
      : spec_(spec),
        ground_truth_m_(spec.world ? spec.world->landmarks_m : ground_truth_of(spec.map)),
        at_(spec.world ? spec.world->landmarks_m : positions_of(spec.map, ground_truth_m_)),
        ground_(spec.world ? room_ground(spec.world->side_m) : ground_of(at_)),
        side_(ground_.side()),
        radius_(spec.world ? pillar_radius_m(*spec.world) : kOpenRadius * side_) {
    found_ = displacements(ground_truth_m_, spec.map.estimate, ground_);
    if (!spec.world) {  // Landmarks without a true position may be missing, too.
      const MapView view = view_of(spec.map);
      found_.far = view.outside.size();
      found_.missing = view.unmapped.size();
    }
    scene_.id = spec.id;
    scene_.title = spec.title;
    scene_.record_ids = {spec.map.id};
    scene_.lights = usual_lights();
    scene_.views = {ground_view(ground_, landmark_height(side_), found_.arrows.to)};
    if (spec.map.frame == Frame::kSimilarity) {  // Its unit is arbitrary.
      scene_.views[0].rules[0].label = "x";
      scene_.views[0].rules[1].label = "y";
    }
  }

  Scene make() {
    add_parts();
    add_names();
    describe();
    return std::move(scene_);
  }

 private:
  void add_parts() {
    scene_.parts = {
        floor_of(ground_), spec_.world ? walls_of(side_) : walls_of(ground_, kKerbShare * side_),
        grid_of(ground_),  landmarks(false),
        landmarks(true),   rings(at_, rows_of(true), radius_)};
    const Eigen::Index last = spec_.path_m.rows() - 1;
    for (Tube& piece : fading_path(spec_.path_m, last, side_))
      scene_.parts.emplace_back(std::move(piece));
    if (last >= 1 && spec_.path_m.row(last).allFinite())
      scene_.parts.emplace_back(robot_at(spec_.path_m.row(last), side_));
    if (found_.drawn.empty()) return;
    Rods arrows = found_.arrows;
    arrows.label = "true to estimated position";
    arrows.style.colour = ThemeColour::kText;
    scene_.parts.emplace_back(std::move(arrows));
  }

  std::vector<Eigen::Index> rows_of(bool anchors) const {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < at_.rows(); ++i)
      if (is_anchor(spec_.map, i) == anchors) rows.push_back(i);
    return rows;
  }

  Rods landmarks(bool anchors) const {
    const std::vector<Eigen::Index> rows = rows_of(anchors);
    Rods rods = pillars(at_, rows, radius_, landmark_height(side_));
    rods.style.colour = anchors ? ThemeColour::kText : ThemeColour::kSeries1;
    if (anchors) {
      rods.label = "anchor";
    } else {
      rods.label = "landmark";
      rods.tones = tones(rows);
      if (!rods.tones.values.empty()) {
        rods.style.colour = ThemeColour::kMuted;  // Of those without a value.
        rods.tones.bar_label = has_errors() ? "error of the landmark [m]"
                               : spec_.map.frame == Frame::kGroundTruth
                                   ? "longer half axis of the ellipse [m]"
                                   : "longer half axis of the ellipse";
      }
    }
    if (rods.from.empty()) rods.label.clear();
    return rods;
  }

  /// Whether the error of a landmark other than the anchors is known.
  bool has_errors() const {
    return std::ranges::any_of(rows_of(false),
                               [this](Eigen::Index row) { return std::isfinite(error_of(row)); });
  }

  double error_of(Eigen::Index row) const {
    return (spec_.map.estimate.row(row) - ground_truth_m_.row(row)).norm();
  }

  /// What colours each landmark that pillars() draws; NaN, and so grey, where it is not known.
  Tones tones(const std::vector<Eigen::Index>& rows) const {
    Tones tones;
    const bool errors = has_errors();
    if (!errors && spec_.half_axes.empty()) return tones;
    std::vector<double> known;
    for (const Eigen::Index row : rows) {
      if (!at_.row(row).allFinite()) continue;
      const double value = errors ? error_of(row) : spec_.half_axes[static_cast<std::size_t>(row)];
      tones.values.push_back(std::isfinite(value) ? value : kNaN);
      if (std::isfinite(value)) known.push_back(value);
    }
    tones.limits = {0.0, known.empty() ? 1.0 : end_of_error_ramp(std::move(known))};
    return tones;
  }

  void add_names() {
    SceneLabels names{.colour = ThemeColour::kText};
    for (const Eigen::Index row : spec_.map.anchors) add_name(names, row);
    for (const std::size_t i : worst()) add_name(names, found_.drawn[i]);
    scene_.views[0].labels.push_back(std::move(names));
  }

  void add_name(SceneLabels& names, Eigen::Index row) const {
    if (!at_.row(row).allFinite()) return;
    names.at.push_back(on_floor(at_.row(row), landmark_height(side_)));
    names.text.push_back(spec_.map.names[static_cast<std::size_t>(row)]);
  }

  /// Indices in `found_` of the largest errors of landmarks that are not anchors.
  std::vector<std::size_t> worst() const {
    std::vector<std::size_t> order(found_.drawn.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [this](std::size_t i) { return is_anchor(spec_.map, found_.drawn[i]); });
    std::ranges::stable_sort(order, std::greater<>(),
                             [this](std::size_t i) { return found_.errors_m[i]; });
    order.resize(std::min(order.size(), kMostWorst));
    return order;
  }

  /// "50 landmarks of 48 mm in diameter", and what their colours say.
  std::string landmarks_text() const {
    const auto count = static_cast<std::size_t>(at_.rows());
    std::string text = counted(count, "landmark");
    if (spec_.world)
      text += fmt::format(" of {} mm in diameter",
                          significant(1000.0 * spec_.world->landmark_diameter_m));
    return text + " (heights not to scale)";
  }

  void describe() {
    for (const std::string& words : {words_of_missing(found_, spec_.world ? "room" : "ground"),
                                     spec_.world ? words_of_pillars(*spec_.world) : ""})
      if (!words.empty()) scene_.notes.push_back({words, ThemeColour::kWarning});
    const auto count = static_cast<std::size_t>(at_.rows());
    scene_.caption = spec_.where.empty() ? "" : spec_.where + ": ";
    scene_.caption += landmarks_text();
    if (const Eigen::Index last = spec_.path_m.rows() - 1; last >= 1)
      scene_.caption += ", the robot's path over the last " +
                        counted(last - first_shown(spec_.path_m, last, side_), "step");
    scene_.caption += fmt::format(", and where {} of {} puts each landmark.",
                                  spec_.method.empty() ? method_label(spec_.map) : spec_.method,
                                  counted(spec_.map.step, "step"));
    const Tones shown = tones(rows_of(false));
    if (!shown.values.empty())
      scene_.caption += fmt::format(
          " {} above {}{} have the last colour.", has_errors() ? "Errors" : "Half axes",
          significant(shown.limits.high, 2), spec_.map.frame == Frame::kGroundTruth ? " m" : "");
    scene_.alt = spec_.world
                     ? fmt::format("A room of {} m by {} m", significant(side_), significant(side_))
                     : "Ground";
    scene_.alt += fmt::format(" with {}, {} of them anchors", counted(count, "landmark"),
                              spec_.map.anchors.size());
    if (spec_.map.score && std::isfinite(spec_.map.score->mpe_m))
      scene_.alt += fmt::format("; mean position error {}", error_text(spec_.map.score->mpe_m));
    if (const auto order = worst(); !order.empty()) {
      const auto row = static_cast<std::size_t>(found_.drawn[order[0]]);
      scene_.alt += fmt::format("; the longest arrow, at {}, is {} m", spec_.map.names[row],
                                significant(found_.errors_m[order[0]]));
    }
    scene_.alt += ".";
  }

  const MapSceneSpec& spec_;
  Points ground_truth_m_, at_;
  Ground ground_;
  double side_, radius_;
  Displacements found_;
  Scene scene_;
};

}  // namespace

bool has_map_scene(const MapRecord& map) {
  if (map.estimate.rows() > kMostPillars) return false;
  const Points at = positions_of(map, ground_truth_of(map));
  constexpr int kFewest = 3;
  int mapped = 0;
  for (Eigen::Index i = 0; i < at.rows(); ++i)
    mapped += at.row(i).allFinite() && map.estimate.row(i).allFinite() ? 1 : 0;
  if (mapped < kFewest) return false;
  const Ground ground = ground_of(at);
  const double most = std::max({std::abs(ground.low.x), std::abs(ground.low.y),
                                std::abs(ground.high.x), std::abs(ground.high.y)});
  // The positions are drawn in single precision.
  constexpr double kLeastShare = 1e-4;
  return is_room_side(ground.side()) && most <= kLongestSide_m &&
         ground.side() > kLeastShare * most;
}

Scene map_scene(const MapSceneSpec& spec) {
  require_usable(spec);
  Scene scene = MapScene(spec).make();
  require_valid(scene);
  return scene;
}

}  // namespace mapproof
