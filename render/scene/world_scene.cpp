#include "render/scene/world_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/number_text.hpp"
#include "render/scene/displacements.hpp"
#include "render/scene/room.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

constexpr double kHighest = 0.35;           // The surface at the ramp's end, of the room's side.
constexpr double kErrorFieldAspect = 1.35;  // Several views share a page.
constexpr double kLift = 0.004;             // Of the side: no error still lies above the floor.
constexpr double kErrorPercentile = 0.95;
constexpr int kMostLevels = 6;

/// A landmark that has a true position and an estimate.
struct Sample {
  Eigen::RowVector2d at_m;
  double error_m = 0.0;
};

std::vector<Sample> samples_of(const MapRecord& map) {
  std::vector<Sample> samples;
  if (!map.ground_truth_m || map.frame != Frame::kGroundTruth ||
      map.ground_truth_m->rows() != map.estimate.rows())
    return samples;
  for (Eigen::Index i = 0; i < map.estimate.rows(); ++i) {
    const Eigen::RowVector2d at = map.ground_truth_m->row(i);
    const double error = (map.estimate.row(i) - at).norm();
    const auto above = [&at](const Sample& one) { return one.at_m == at; };
    if (at.allFinite() && std::isfinite(error) && std::ranges::none_of(samples, above))
      samples.push_back({at, error});
  }
  return samples;
}

/// Whether some three of the positions span an area.
bool spans_area(const std::vector<Sample>& samples, double side_m) {
  for (std::size_t i = 1; i < samples.size(); ++i)
    for (std::size_t j = i + 1; j < samples.size(); ++j) {
      const Eigen::RowVector2d a = samples[i].at_m - samples[0].at_m;
      const Eigen::RowVector2d b = samples[j].at_m - samples[0].at_m;
      if (std::abs(a.x() * b.y() - a.y() * b.x()) > 1e-9 * side_m * side_m) return true;
    }
  return false;
}

/// Ends of the ramp, and where its contours are.
struct ErrorRamp {
  double most_m = 0.0;
  std::vector<double> levels;

  explicit ErrorRamp(std::vector<double> errors_m) {
    std::ranges::sort(errors_m);
    const auto rank = static_cast<std::size_t>(
        std::lround(kErrorPercentile * static_cast<double>(errors_m.size() - 1)));
    most_m = std::max(errors_m[rank], 1e-6);
    const double step = tick_step(0.0, most_m, kMostLevels);
    for (double level = step; level < most_m; level += step) levels.push_back(level);
  }
};

Field field_of(const std::vector<Sample>& samples, const ErrorRamp& scale, double side_m) {
  Field field{.label = fmt::format(
                  "position error, 0 to {} m or more; a line every {} m", significant(scale.most_m),
                  significant(scale.levels.empty() ? scale.most_m : scale.levels[0], 2)),
              .levels = scale.levels,
              .contour_radius = 0.0025 * side_m};
  field.tones.limits = {0.0, scale.most_m};
  for (const Sample& sample : samples) {
    const double shown = std::min(sample.error_m, scale.most_m);
    const double height = (kLift + kHighest * shown / scale.most_m) * side_m;
    field.points.push_back(on_floor(sample.at_m, height));
    field.tones.values.push_back(sample.error_m);
  }
  return field;
}

constexpr std::size_t kMostWorst = 3;

void require_usable(const WorldSceneSpec& spec) {
  const World& world = spec.world;
  if (!has_room(world))
    throw InvalidInput("world_scene: the room's side or the landmarks' diameter is not a length");
  if (spec.map.estimate.rows() != world.landmarks_m.rows() ||
      spec.map.names.size() != static_cast<std::size_t>(world.landmarks_m.rows()))
    throw InvalidInput("world_scene: the map is not of the world's landmarks");
  for (const Eigen::Index row : spec.map.anchors)
    if (row < 0 || row >= world.landmarks_m.rows())
      throw InvalidInput("world_scene: an anchor is not a landmark");
}

class WorldScene {
 public:
  WorldScene(const WorldSceneSpec& spec, WorldView view)
      : spec_(spec), world_(spec.world), side_(spec.world.side_m) {
    found_ = displacements(world_.landmarks_m, spec.map.estimate, side_);
    scene_.id = spec.id;
    scene_.title = spec.title;
    scene_.record_ids = {spec.map.id};
    scene_.lights = usual_lights();
    scene_.views = {view == WorldView::kPlan
                        ? room_plan(side_, found_.arrows.to)
                        : room_view(side_, landmark_height(side_), found_.arrows.to)};
  }

  Scene make() {
    add_parts();
    add_association();
    describe();
    return std::move(scene_);
  }

 private:
  void add_parts() {
    scene_.parts = {floor_of(side_), walls_of(side_), landmarks(false), landmarks(true)};
    for (Tube& piece : fading_path(spec_.path_m, spec_.path_m.rows() - 1, side_))
      scene_.parts.emplace_back(std::move(piece));
    Rods arrows = found_.arrows;
    arrows.label = "true to estimated position";
    arrows.style.colour = ThemeColour::kText;
    scene_.parts.emplace_back(std::move(arrows));
  }

  std::vector<Eigen::Index> rows_of(bool anchors) const {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < world_.landmarks_m.rows(); ++i)
      if (is_anchor(i) == anchors) rows.push_back(i);
    return rows;
  }

  Rods landmarks(bool anchors) const {
    const std::vector<Eigen::Index> rows = rows_of(anchors);
    Rods rods = pillars(world_.landmarks_m, rows, pillar_radius_m(world_), landmark_height(side_));
    rods.style.colour = anchors ? ThemeColour::kText : ThemeColour::kMuted;
    if (anchors) {
      rods.label = "anchor";
    } else {
      rods.tones = tones(rows);
      rods.tones.bar_label = "error of the landmark [m]";
      rods.label = "landmark";
    }
    if (rods.from.empty()) rods.label.clear();
    return rods;
  }

  /// The error of each landmark that pillars() draws; NaN, and so grey, where there is none.
  Tones tones(const std::vector<Eigen::Index>& rows) const {
    Tones tones;
    std::vector<double> errors_m;
    for (const Eigen::Index row : rows) {
      if (!world_.landmarks_m.row(row).allFinite()) continue;
      const double error = (spec_.map.estimate.row(row) - world_.landmarks_m.row(row)).norm();
      tones.values.push_back(std::isfinite(error) ? error : kNaN);
      if (std::isfinite(error)) errors_m.push_back(error);
    }
    tones.limits = {0.0, errors_m.empty() ? 1.0 : ErrorRamp(errors_m).most_m};
    return tones;
  }

  void add_association() {
    SceneLabels anchors{.colour = ThemeColour::kText};
    for (const Eigen::Index row : spec_.map.anchors) add_label(anchors, row);
    for (const std::size_t i : worst()) add_label(anchors, found_.drawn[i]);
    scene_.views[0].labels.push_back(std::move(anchors));
  }

  void add_label(SceneLabels& labels, Eigen::Index row) const {
    if (!world_.landmarks_m.row(row).allFinite()) return;
    labels.at.push_back(on_floor(world_.landmarks_m.row(row), landmark_height(side_)));
    labels.text.push_back(spec_.map.names[static_cast<std::size_t>(row)]);
  }

  /// Indices in `found_` of the largest errors of landmarks that are not anchors.
  std::vector<std::size_t> worst() const {
    std::vector<std::size_t> order(found_.drawn.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [this](std::size_t i) { return is_anchor(found_.drawn[i]); });
    std::ranges::stable_sort(order, std::greater<>(),
                             [this](std::size_t i) { return found_.errors_m[i]; });
    order.resize(std::min(order.size(), kMostWorst));
    return order;
  }

  void describe() {
    for (const std::string& words : {words_of_missing(found_), words_of_pillars(world_)})
      if (!words.empty()) scene_.notes.push_back({words, ThemeColour::kWarning});
    const auto landmarks = static_cast<std::size_t>(world_.landmarks_m.rows());
    scene_.caption = fmt::format(
        "Layout {}, pose {}: {} of {} mm in diameter{}, the robot's path "
        "over the last {} steps, and where {} of {} steps puts each landmark. Errors above {} m "
        "have "
        "the last colour.",
        spec_.run.layout, spec_.run.pose, counted(landmarks, "landmark"),
        significant(1000.0 * world_.landmark_diameter_m),
        scene_.views[0].camera.parallel ? "" : " (heights are the drawing's)",
        std::min(spec_.path_m.rows(), kShownSteps + 1), method_label(spec_.map), spec_.map.step,
        significant(tones(rows_of(false)).limits.high, 2));
    scene_.alt =
        fmt::format("A room of {} m by {} m with {}, {} of them anchors", significant(side_),
                    significant(side_), counted(landmarks, "landmark"), spec_.map.anchors.size());
    if (spec_.map.score)
      scene_.alt += fmt::format("; mean position error {}", error_text(spec_.map.score->mpe_m));
    if (const auto order = worst(); !order.empty()) {
      const auto row = static_cast<std::size_t>(found_.drawn[order[0]]);
      scene_.alt += fmt::format("; the longest arrow, at {}, is {} m", spec_.map.names[row],
                                significant(found_.errors_m[order[0]]));
    }
    scene_.alt += ".";
  }

  bool is_anchor(Eigen::Index row) const {
    return std::ranges::find(spec_.map.anchors, row) != spec_.map.anchors.end();
  }

  const WorldSceneSpec& spec_;
  const World& world_;
  double side_;
  Displacements found_;
  Scene scene_;
};

}  // namespace

bool has_error_field(const MapRecord& map, double side_m) {
  return is_room_side(side_m) && spans_area(samples_of(map), side_m);
}

Scene error_field_scene(const ErrorFieldSpec& spec) {
  if (spec.maps.empty()) throw InvalidInput("error_field_scene: no map");
  if (!is_room_side(spec.side_m))
    throw InvalidInput("error_field_scene: the room's side is not a length");
  std::vector<std::vector<Sample>> samples;
  std::vector<double> errors_m;
  for (const ErrorFieldSpec::One& one : spec.maps) {
    samples.push_back(samples_of(one.map));
    if (!spans_area(samples.back(), spec.side_m))
      throw InvalidInput("error_field_scene: a map without an error field");
    for (const Sample& sample : samples.back()) errors_m.push_back(sample.error_m);
  }
  const ErrorRamp scale(errors_m);
  Scene scene{.id = spec.id,
              .title = spec.title,
              .caption = fmt::format(
                  "Position error over the floor, interpolated between the "
                  "landmarks; heights are errors, {} times as high, cut at {} m, "
                  "the 95th percentile of all.",
                  significant(kHighest * spec.side_m / scale.most_m, 2), significant(scale.most_m)),
              .lights = usual_lights(),
              .columns = spec.columns};
  scene.parts = {floor_of(spec.side_m), walls_of(spec.side_m)};
  for (std::size_t i = 0; i < spec.maps.size(); ++i) {
    Shot view = room_view(spec.side_m, kHighest * spec.side_m, {}, kErrorFieldAspect);
    view.title = spec.maps[i].title;
    view.parts = {0, 1, scene.parts.size()};
    scene.parts.emplace_back(field_of(samples[i], scale, spec.side_m));
    scene.views.push_back(std::move(view));
    scene.record_ids.push_back(spec.maps[i].map.id);
    double sum = 0.0;
    for (const Sample& sample : samples[i]) sum += sample.error_m;
    scene.alt += fmt::format("{}{}: mean error {} m", i == 0 ? "" : "; ", spec.maps[i].title,
                             significant(sum / static_cast<double>(samples[i].size())));
  }
  scene.alt += ".";
  require_valid(scene);
  return scene;
}

Scene world_scene(const WorldSceneSpec& spec, WorldView view) {
  require_usable(spec);
  Scene scene = WorldScene(spec, view).make();
  require_valid(scene);
  return scene;
}

}  // namespace mapproof
