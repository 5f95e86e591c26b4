#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/slam/slam_study.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// The part of a quadric that points lie about, as a sheet over the plane of its two stronger
/// directions, and lines on it.
struct QuadricSurface {
  Surface sheet;
  Rods lines;  ///< Four rings and eight rays.
};

/// @param cloud  Of at least one finite point.
/// @return Without triangles and lines where the quadric has no such sheet.
QuadricSurface quadric_surface(const QuadricPoints& cloud);

/// Distances of the points from the quadric, to first order: |f| over the length of its gradient.
Eigen::VectorXd quadric_distances(const QuadricPoints& cloud);

/// The root mean square of these distances, as a share of the cloud's extent.
double quadric_deviation(const QuadricPoints& cloud);

struct QuadricSceneSpec {
  std::string id;
  std::string title;
  std::string name;  ///< Of the log, in the caption.
  UpgradeClouds clouds;
  std::vector<std::string> record_ids;
};

/// Whether there is a scene of the clouds: two points or more of each that are finite, within 1e6,
/// and neither at one position nor, after the upgrade, at one height.
bool has_quadric_scene(const UpgradeClouds& clouds);

/// What the metric upgrade does [boots2013, section 2], side by side: states of the path, of four
/// entries, as points in space, coloured by time, and the quadric that was fitted to them. Before:
/// whitened, in orthonormal coordinates of the plane of scale 1, where the quadric leans as it
/// will. After: x, y and (x^2 + y^2)/2, on the paraboloid. How far the points are from the surfaces
/// is said in numbers.
/// @throws InvalidInput unless has_quadric_scene().
Scene quadric_scene(const QuadricSceneSpec& spec);

}  // namespace mapproof
