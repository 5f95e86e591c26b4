#pragma once

#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

struct ErrorFieldSpec {
  struct One {
    std::string title;  ///< Above its picture.
    MapRecord map;      ///< In the frame of the truth, with a truth.
  };
  std::string id;
  std::string title;
  double side_m = 0.0;      ///< Of the room.
  std::vector<One> maps;    ///< At least one; a picture each.
  std::size_t columns = 0;  ///< As a figure's.
};

/// Whether a map's errors can be interpolated: it has a truth and is in its frame, and three of its
/// landmarks with a truth and a place span an area.
bool has_error_field(const MapRecord& map, double side_m);

/// Each map's position error over the floor, interpolated between the true positions of the
/// landmarks, as a surface whose height is the error, with lines of equal error. All share one ramp
/// from 0 to the 95th percentile of all errors; what is beyond is cut there.
/// @throws InvalidInput if there is no map, or a map has no error field.
Scene error_field_scene(const ErrorFieldSpec& spec);

}  // namespace mapproof
