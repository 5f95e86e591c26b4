#pragma once

#include <string>
#include <vector>

#include "core/model/upgrade_clouds.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

struct QuadricSceneSpec {
  std::string id;
  std::string title;
  std::string name;  ///< Of the log, in the caption.
  UpgradeClouds clouds;
  std::vector<std::string> record_ids;
};

/// Whether there is a scene of the clouds: two points or more of each that are finite, within 1e6,
/// and neither in one place nor, after the upgrade, at one height.
bool has_quadric_scene(const UpgradeClouds& clouds);

/// What the metric upgrade does [boots2013, section 2], side by side: states of the path, of four
/// entries, as points in space, coloured by time, and the quadric that was fitted to them. Before:
/// whitened, in orthonormal coordinates of the plane of scale 1, where the quadric leans as it
/// will. After: x, y and (x^2 + y^2)/2, on the paraboloid. How far the points are from the surfaces
/// is said in numbers.
/// @throws InvalidInput unless has_quadric_scene().
Scene quadric_scene(const QuadricSceneSpec& spec);

}  // namespace mapproof
