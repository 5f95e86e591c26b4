#pragma once

#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/world.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

struct FormingSceneSpec {
  std::string id;
  std::string title;
  World world;
  std::vector<MapRecord> maps;  ///< Of the world's landmarks by one setting, steps ascending.
  std::size_t most = 6;         ///< Views of the film strip.
  Points path_m = {};  ///< The robot's positions, a row per step, for the animation; or empty.
};

/// How a map forms as observations come in, as a film strip: one room, one camera, one ramp of
/// errors from 0 to the 95th percentile, and a view for each map, or for `most` of them, evenly
/// spread, the first and the last among them. Landmarks stand at their true positions, coloured by
/// their errors; an arrow leads to where the map has each. Estimates far outside the room have no
/// arrow; a note counts them.
/// @throws InvalidInput if there is no map, the steps do not ascend, a map is not in the frame of
///         the ground truth or not of the world's landmarks, or lengths are not positive and
///         finite, or the path has fewer rows than a map has steps.
Scene forming_scene(const FormingSceneSpec& spec);

/// The same as an animation: a frame for each map, all of one layout, with the robot and its path
/// of the last steps; what has no arrow is counted in the frames' titles. The frames' ids end with
/// their number, from 1.
Film forming_film(const FormingSceneSpec& spec);

}  // namespace mapproof
