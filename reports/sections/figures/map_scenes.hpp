#pragma once

#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// The MPE of a map, for an order of maps; infinite if it is not known.
double error_or_infinity(const MapRecord& map);

struct MapInSpace {
  std::string title;
  std::string
      method;  ///< As readers know what made it: its record may name the nearest one of ours.
  const MapRecord* map = nullptr;
};

/// The map with the least MPE in space, or without any score the first one that can be drawn; none
/// if none can.
/// @param id  Of the scene.
std::vector<Scene> best_map_scene(const std::string& id, const std::vector<MapInSpace>& maps);

}  // namespace mapproof
