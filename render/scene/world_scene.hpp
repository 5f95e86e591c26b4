#pragma once

#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/study.hpp"
#include "core/model/world.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

struct ErrorFieldSpec {
  struct One {
    std::string title;  ///< Above its image.
    MapRecord map;      ///< In the frame of the ground truth, with ground truth.
  };
  std::string id;
  std::string title;
  double side_m = 0.0;      ///< Of the room.
  std::vector<One> maps;    ///< At least one; one image per map.
  std::size_t columns = 0;  ///< As a figure's.
};

/// Whether a map's errors can be interpolated: it has ground truth and is in its frame, and three
/// of its landmarks with a true position and an estimate span an area.
bool has_error_field(const MapRecord& map, double side_m);

/// Each map's position error over the floor, interpolated between the true positions of the
/// landmarks, as a surface whose height is the error, with lines of equal error. All share one ramp
/// from 0 to the 95th percentile of all errors; what is beyond is cut there.
/// @throws InvalidInput if there is no map, or a map has no error field.
Scene error_field_scene(const ErrorFieldSpec& spec);

enum class WorldView { kPerspective, kPlan };

struct WorldSceneSpec {
  std::string id;
  std::string title;
  RunId run;
  World world;
  Points path_m;  ///< N x 2, in order; may be empty.
  MapRecord map;  ///< In the frame of the ground truth, of the world's landmarks.
};

/// The room with its landmarks at their true diameter, anchors apart, the robot's path as a tube
/// coloured by time, and an arrow on the floor from each true to its estimated position. Estimates
/// more than .75 room sides outside the room have no arrow; a note counts them. The worst three
/// landmarks and the anchors are named.
/// @throws InvalidInput if the map's landmarks are not as many as the world's, or lengths are not
///         positive and finite.
Scene world_scene(const WorldSceneSpec& spec, WorldView view);

}  // namespace mapproof
