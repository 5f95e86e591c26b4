#pragma once

#include <string>

#include "core/model/map_record.hpp"
#include "core/model/study.hpp"
#include "core/model/world.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

enum class WorldView { kPerspective, kPlan };

struct WorldSceneSpec {
  std::string id;
  std::string title;
  RunId run;
  World world;
  Points path_m;  ///< N x 2, in order; may be empty.
  MapRecord map;  ///< In the frame of the truth, of the world's landmarks.
};

/// The room with its landmarks at their true diameter, anchors apart, the robot's path as a tube
/// coloured by time, and an arrow on the floor from each true to its estimated position. Estimates
/// more than .75 room sides outside the room have no arrow; a note counts them. The worst three
/// landmarks and the anchors are named.
/// @throws InvalidInput if the map's landmarks are not as many as the world's, or lengths are not
///         positive and finite.
Scene world_scene(const WorldSceneSpec& spec, WorldView view);

}  // namespace mapproof
