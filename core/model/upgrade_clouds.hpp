#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/space_points.hpp"

namespace mapproof {

/// Points in space and the quadric that was fitted to them, [p' 1] Q [p' 1]' = 0.
struct QuadricPoints {
  SpacePoints points;
  Eigen::Matrix4d Q = Eigen::Matrix4d::Zero();
};

/// How a metric upgrade changed the states of the robot's positions, some of them, evenly spread.
struct UpgradeClouds {
  std::vector<Eigen::Index> steps;  ///< Of the estimated path, ascending: a row of each cloud.
  QuadricPoints before;             ///< Whitened, in their plane of scale 1; no unit.
  QuadricPoints after;  ///< (x, y, (x^2 + y^2)/2) about the mean position, m, m and m^2.
};

}  // namespace mapproof
