#include "render/scene/forming_scene.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/error_ramp.hpp"
#include "render/scene/displacements.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

constexpr double kFormingAspect = 1.4;

void require_usable(const FormingSceneSpec& spec) {
  const World& world = spec.world;
  if (spec.maps.empty() || spec.most < 1) throw InvalidInput("forming_scene: no map");
  if (!has_room(world))
    throw InvalidInput("forming_scene: the room's side or the landmarks' diameter is not a length");
  const Eigen::Index landmarks = world.landmarks_m.rows();
  for (std::size_t i = 0; i < spec.maps.size(); ++i) {
    const MapRecord& map = spec.maps[i];
    if (map.estimate.rows() != landmarks)
      throw InvalidInput("forming_scene: a map is not of the world's landmarks");
    if (map.frame != Frame::kGroundTruth)
      throw InvalidInput("forming_scene: a map is not in the frame of the ground truth");
    if (spec.path_m.rows() > 0 && spec.path_m.rows() < map.step)
      throw InvalidInput("forming_scene: the path has fewer positions than a map has steps");
    if (i > 0 && map.step <= spec.maps[i - 1].step)
      throw InvalidInput("forming_scene: the steps do not ascend");
    for (const Eigen::Index row : map.anchors)
      if (row < 0 || row >= landmarks)
        throw InvalidInput("forming_scene: an anchor is not a landmark");
  }
}

/// Three, but four views two by two.
std::size_t columns_of(std::size_t views) {
  return views == 4 ? 2 : std::min<std::size_t>(3, views);
}

class Forming {
 public:
  explicit Forming(const FormingSceneSpec& spec) : spec_(spec), side_(spec.world.side_m) {
    std::vector<double> errors;
    for (const MapRecord& map : spec.maps) {
      found_.push_back(displacements(spec.world.landmarks_m, map.estimate, room_ground(side_)));
      const Displacements& found = found_.back();
      errors.insert(errors.end(), found.errors_m.begin(), found.errors_m.end());
      ends_.insert(ends_.end(), found.arrows.to.begin(), found.arrows.to.end());
    }
    most_m_ = end_of_error_ramp(std::move(errors));
  }

  /// Views of those maps; with the path, that up to the last of them.
  Scene make(std::string id, const std::vector<std::size_t>& shown, bool with_path) const {
    Scene scene{.id = std::move(id), .title = spec_.title, .lights = usual_lights()};
    scene.columns = columns_of(shown.size());
    scene.parts = {floor_of(side_), walls_of(side_), grid_of(room_ground(side_)), anchors(),
                   rings(spec_.world.landmarks_m, rows(true), pillar_radius_m(spec_.world))};
    if (with_path) add_path(spec_.maps[shown.back()].step, scene);
    const std::size_t shared = scene.parts.size();
    Displacements lost;
    for (const std::size_t i : shown) {
      Shot view = room_view(side_, landmark_height(side_), ends_, kFormingAspect);
      if (shown.size() > 1) view.rules.clear();
      view.title = title_of(i);
      for (std::size_t part = 0; part < shared; ++part) view.parts.push_back(part);
      const bool is_first = scene.views.empty();
      for (Rods part : {landmarks(i, is_first), arrows(i, is_first)}) {
        view.parts.push_back(scene.parts.size());
        scene.parts.emplace_back(std::move(part));
      }
      scene.views.push_back(std::move(view));
      scene.record_ids.push_back(spec_.maps[i].id);
      lost.far += found_[i].far;
      lost.missing += found_[i].missing;
    }
    add_notes(lost, scene);
    describe(scene, shown);
    require_valid(scene);
    return scene;
  }

 private:
  void add_path(Eigen::Index steps, Scene& scene) const {
    if (spec_.path_m.rows() < steps || steps < 2) return;
    for (Tube& piece : fading_path(spec_.path_m, steps - 1, side_)) {
      if (!piece.label.empty()) piece.label = "path, its last steps";  // One text in all frames.
      scene.parts.emplace_back(std::move(piece));
    }
    const Eigen::RowVector2d at = spec_.path_m.row(steps - 1);
    if (at.allFinite()) scene.parts.emplace_back(robot_at(at, side_));
  }

  std::vector<Eigen::Index> rows(bool of_anchors) const {
    const std::vector<Eigen::Index>& given = spec_.maps.back().anchors;
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < spec_.world.landmarks_m.rows(); ++i)
      if ((std::ranges::find(given, i) != given.end()) == of_anchors) rows.push_back(i);
    return rows;
  }

  Rods pillars_of(const std::vector<Eigen::Index>& rows) const {
    return pillars(spec_.world.landmarks_m, rows, pillar_radius_m(spec_.world),
                   landmark_height(side_));
  }

  Rods anchors() const {
    Rods rods = pillars_of(rows(true));
    rods.label = rods.from.empty() ? "" : "anchor";
    rods.style.colour = ThemeColour::kText;
    return rods;
  }

  /// The landmarks of a map by their errors, grey where it has none.
  Rods landmarks(std::size_t map, bool in_legend) const {
    const Points& landmarks_m = spec_.world.landmarks_m;
    const std::vector<Eigen::Index> shown = rows(false);
    Rods rods = pillars_of(shown);
    rods.style.colour = ThemeColour::kMuted;
    rods.tones.limits = {0.0, most_m_};
    for (const Eigen::Index row : shown)
      if (landmarks_m.row(row).allFinite())
        rods.tones.values.push_back(
            (spec_.maps[map].estimate.row(row) - landmarks_m.row(row)).norm());
    if (in_legend && !rods.from.empty())
      rods.label = "landmark, its error from " + error_ramp_text(most_m_);
    return rods;
  }

  Rods arrows(std::size_t map, bool in_legend) const {
    Rods arrows = found_[map].arrows;
    if (in_legend) arrows.label = "true to estimated position";
    arrows.style.colour = ThemeColour::kText;
    return arrows;
  }

  /// A note under the title would move a frame against the others.
  void add_notes(const Displacements& lost, Scene& scene) const {
    if (const std::string wide = words_of_pillars(spec_.world);
        !wide.empty() && scene.views.size() > 1)
      scene.notes.push_back({wide, ThemeColour::kWarning});
    const std::string words = words_of_missing(lost);
    if (words.empty()) return;
    if (scene.views.size() > 1)
      scene.notes.push_back({"Over all views: " + words, ThemeColour::kWarning});
    else
      scene.views[0].title += ". " + words;
  }

  std::string error_of(std::size_t map) const {
    const auto& score = spec_.maps[map].score;
    return score && std::isfinite(score->mpe_m) ? error_text(score->mpe_m) : "no score";
  }

  std::string title_of(std::size_t map) const {
    const bool is_scored = spec_.maps[map].score && std::isfinite(spec_.maps[map].score->mpe_m);
    return fmt::format("{}, {}{}", counted(spec_.maps[map].step, "step"), is_scored ? "MPE " : "",
                       error_of(map));
  }

  void describe(Scene& scene, const std::vector<std::size_t>& shown) const {
    scene.caption = fmt::format(
        "{}: the map after so many steps, with its mean position error. Pillars stand at true "
        "positions, coloured by their errors up to {} m, the 95th percentile over all steps; "
        "arrows lead to where the map has them.",
        method_label(spec_.maps.front()), significant(most_m_, 2));
    scene.alt =
        "A room with arrows from true to estimated positions of landmarks; mean position "
        "error ";
    for (std::size_t k = 0; k < shown.size(); ++k)
      scene.alt += fmt::format("{}{} after {}", k == 0 ? "" : ", ", error_of(shown[k]),
                               counted(spec_.maps[shown[k]].step, "step"));
    scene.alt += ".";
  }

  const FormingSceneSpec& spec_;
  double side_;
  std::vector<Displacements> found_;
  std::vector<Point3> ends_;  // Of all maps' arrows.
  double most_m_ = 0.0;
};

}  // namespace

Scene forming_scene(const FormingSceneSpec& spec) {
  require_usable(spec);
  const std::size_t size = spec.maps.size(), count = std::min(spec.most, size);
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < count; ++i)
    shown.push_back(count > 1 ? i * (size - 1) / (count - 1) : size - 1);
  return Forming(spec).make(spec.id, shown, false);
}

Film forming_film(const FormingSceneSpec& spec) {
  require_usable(spec);
  const Forming forming(spec);
  Film film{.id = spec.id, .frames = {}};
  for (std::size_t i = 0; i < spec.maps.size(); ++i)
    film.frames.push_back(forming.make(fmt::format("{}-{}", spec.id, i + 1), {i}, true));
  return film;
}

}  // namespace mapproof
