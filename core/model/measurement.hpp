#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/model/sensor.hpp"
#include "core/model/study.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// What keeps a landmark from being seen, if anything does.
enum class View {
  kVisible,
  kHidden,      ///< Within reach, but another landmark cuts the ray to its centre.
  kOutOfReach,  ///< Scans narrower than the visual angle.
};

/// The name used in files: "visible", "hidden", "out_of_reach".
std::string_view name(View view);

/// What one sensor measured at one step of one run, and where everything stood.
struct Measurement {
  Sensor sensor = Sensor::kVisibility;
  RunId run;
  int step = 1;  ///< Counted from 1.
  World world;
  Points path_m;  ///< Positions up to the step, in order; may be empty.
  Eigen::RowVector2d robot_m = Eigen::RowVector2d::Zero();
  double heading_rad = 0.0;
  double reach_m = 0.0;          ///< Visibility: the farthest that a landmark's centre is seen.
  std::vector<View> views;       ///< Visibility: M.
  Eigen::VectorXd bearings_rad;  ///< Bearing: M, relative to the heading; NaN where none came.
};

}  // namespace mapproof
